#pragma once
// Impacts of random bodies, and impacts whose outcome is known, for the tests of this chapter.
#include <Eigen/LU>
#include <algorithm>
#include <string>
#include <vector>

#include "07_impacts/impacts.hpp"
#include "checks.hpp"
#include "random_input.hpp"

namespace spook::testing {

/// One impact and the lesson's formulas for it: the right results, and those of known mistakes.
struct Impact {
  Mat3 K;
  Vec3 u, n;
  double e = 0, mu = 0;

  double approach() const { return -u.dot(n); }
  Vec3 slip() const { return u + approach() * n; }
  Vec3 t() const { return slip().normalized(); }  // zero without slip
  Vec3 wanted() const { return e * approach() * n; }
  Vec3 solve(const Vec3& velocity) const { return K.inverse() * velocity; }

  Vec3 stick() const { return solve(wanted() - u); }          // Eq. (7.3)
  double eased() const { return n.dot(K * (n - mu * t())); }  // the denominator of Eq. (7.5)
  Vec3 slide() const { return (1 + e) * approach() / eased() * (n - mu * t()); }
  Vec3 P() const { return approach() / n.dot(K * n) * n; }
  Vec3 D() const { return solve(-u) - P(); }  // Q - P
  Vec3 safe(double kappa) const { return (1 + e) * P() + kappa * D(); }
  Vec3 safe() const { return safe(std::min(1.0, kappa_of_the_edge())); }

  /// The κ at which J leaves the cone, Eq. (7.8); infinity if it never does.
  double kappa_of_the_edge() const { return leaves() > 0 ? kappa_by_division() : infinity; }
  double kappa_by_division() const { return mu * (1 + e) * P().dot(n) / leaves(); }

  /// Returns the rate at which J leaves the cone as κ grows; negative if J goes deeper into the cone.
  double leaves() const {
    const double D_n = D().dot(n);
    return (D() - D_n * n).norm() - mu * D_n;
  }

  bool inside(const Vec3& J) const {
    const double J_n = J.dot(n);
    return J_n >= 0 && (J - J_n * n).norm() <= mu * J_n;
  }
  double work(const Vec3& J) const { return J.dot(u) + J.dot(K * J) / 2; }

  /// Solving with K costs as many roundings as its condition.
  double condition() const { return K.norm() * K.inverse().norm(); }
  Tolerance impulse_roundings(double count) const {
    return roundings(count * condition(), (1 + e) * K.inverse().norm() * u.norm());
  }
  /// The same for the safe impulse. If D is nearly parallel to an edge of the cone, κ has fewer digits.
  Tolerance safe_roundings(double count) const { return impulse_roundings(count * edge_loss()); }
  double edge_loss() const {
    const double kappa = kappa_of_the_edge();
    return kappa < 1 ? 1 + (1 + mu) * D().norm() * kappa / (mu * (1 + e) * P().norm()) : 1;
  }
  /// The sliding impulse loses digits to a small denominator, and t to a small slip.
  Tolerance slide_roundings(double count) const {
    return roundings(count * (1 + mu) * K.norm() / eased() * u.norm() / slip().norm(), slide().norm());
  }
  Tolerance velocity_roundings(double count, const Vec3& J) const {
    return roundings(count * condition(), u.norm() + K.norm() * J.norm());
  }
  Tolerance energy_roundings(double count, const Vec3& J) const {
    return roundings(count * condition(), J.norm() * (u.norm() + K.norm() * J.norm()));
  }

  std::string text() const {
    return "given K = " + show(Eigen::MatrixXd(K)) + "/kg, u = " + show(u) + " m/s, n = " + show(n) +
           ", e = " + show(e) + ", μ = " + show(mu);
  }
};

/// Returns a solid box of 0.2 to 5 kg, from a cube to a rod or a sheet, in any orientation. A unit impulse
/// anywhere on it moves that point by 1/m to 7/m: the condition of K is at most 7.
struct SolidBox {
  double mass;
  Vec3 half;  ///< half the edges [m]
  Quat q;
  InverseMass<6> inverse_mass;
  Mat3 inertia;

  explicit SolidBox(Random& random)
      : mass(random.log_uniform(0.2, 5)),
        half{random.log_uniform(0.1, 1), random.log_uniform(0.1, 1), random.log_uniform(0.1, 1)},
        q(random.rotation()) {
    const Vec3 squares = half.cwiseProduct(half);
    const Vec3 moments = mass / 3 * (Vec3::Constant(squares.sum()) - squares);
    const Mat3 R = q.toRotationMatrix();
    inertia = R * moments.asDiagonal() * R.transpose();
    inverse_mass = {1 / mass, R * moments.cwiseInverse().asDiagonal() * R.transpose()};
  }

  Vec3 point_of_surface(Random& random) const {
    Vec3 point = random.vector();
    const int axis = random.integer(0, 2);
    point[axis] = random.integer(0, 1) ? 1 : -1;
    return q * point.cwiseProduct(half);
  }
};

/// Solid boxes that move, and forces that act on them.
struct Boxes {
  std::vector<SolidBox> boxes;
  Motion<6> motion;

  Boxes(Random& random, int count) {
    for (int k = 0; k < count; ++k) {
      boxes.emplace_back(random);
      motion.inverse_mass.push_back(boxes.back().inverse_mass);
      const Vec3 v = random.vector(), omega = random.vector(), v_f = random.vector(0.2);
      motion.W.push_back((Twist<6>() << v, omega).finished());
      motion.Wf.push_back((Twist<6>() << v_f, random.vector(0.2)).finished());
    }
  }

  /// Returns a contact at which two boxes approach each other, with or without forces.
  Contact contact(Random& random, int i, int j) const {
    const Vec3 r_i = boxes[i].point_of_surface(random);
    const Vec3 r_j = boxes[j].point_of_surface(random);
    Contact contact{.i = i, .j = j, .n = random.unit_vector(), .gap = 0, .r_i = r_i, .r_j = r_j};
    if (velocity(contact, 0.5).dot(contact.n) > 0) contact.n = -contact.n;
    return contact;
  }

  /// Velocity of j's contact point relative to i's at W + part W_f: Eq. (7.1) for a part of 1/2.
  Vec3 velocity(const Contact& contact, double part) const {
    return point_velocity(contact.j, contact.r_j, part) - point_velocity(contact.i, contact.r_i, part);
  }

  Vec3 point_velocity(int body, const Vec3& r, double part) const {
    const Twist<6> W = motion.W[body] + part * motion.Wf[body];
    return W.head<3>() + W.tail<3>().cross(r);
  }

  Mat3 K(const Contact& contact) const {
    return collision_matrix(motion.inverse_mass[contact.i], contact.r_i, motion.inverse_mass[contact.j],
                            contact.r_j);
  }

  /// Returns the kinetic energy of all boxes at the velocities W + part W_f [J].
  double kinetic_energy(double part) const {
    double energy = 0;
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      const Twist<6> W = motion.W[k] + part * motion.Wf[k];
      const Vec3 v = W.head<3>(), omega = W.tail<3>();
      energy += (boxes[k].mass * v.squaredNorm() + omega.dot(boxes[k].inertia * omega)) / 2;
    }
    return energy;
  }
};

/// Two boxes that approach each other, with μ from 0.05 to 5, and e from 0 to 1, sometimes exactly 0 or 1.
inline Impact random_impact(Random& random) {
  const Boxes pair(random, 2);
  const Contact contact = pair.contact(random, 0, 1);
  const double e = std::clamp(random.uniform(-0.1, 1.1), 0.0, 1.0);
  return {pair.K(contact), pair.velocity(contact, 0.5), contact.n, e, random.log_uniform(0.05, 5)};
}

/// The same with any K, also one that no boxes have: eigenvalues of 0.05 to about 9, in any direction.
inline Impact impact_of_any_K(Random& random) {
  Mat3 A;
  for (int column = 0; column < 3; ++column) A.col(column) = random.vector();
  Impact impact = random_impact(random);
  impact.K = A * A.transpose() + 0.05 * Mat3::Identity();
  return impact;
}

/// A solid sphere on a fixed plane: 1/m along the normal z; 7/2 of that along the plane, where it also turns.
inline Mat3 K_of_sphere(double mass) {
  return Vec3(3.5, 3.5, 1).asDiagonal() * (1 / mass);
}

/// A thin rod of 1 kg, of any length, at 45° in the x-z plane, whose lower end hits a static floor. A unit impulse
/// moves the end by 1/m along the rod's direction d, and by 4/m across: K = (4 - 3 d dᵀ)/m.
inline Mat3 K_of_rod() {
  return (Mat3() << 2.5, 0, -1.5, 0, 4, 0, -1.5, 0, 2.5).finished();
}

}  // namespace spook::testing
