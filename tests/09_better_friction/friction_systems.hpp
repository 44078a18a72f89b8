#pragma once
// Bodies with friction between them, and rows as in chapter 09, for its tests.
#include <Eigen/Dense>
#include <numbers>
#include <string>
#include <vector>

#include "09_better_friction/better_friction.hpp"
#include "algebra.hpp"
#include "checks.hpp"
#include "dense_rows.hpp"
#include "random_input.hpp"

namespace spook::testing {

constexpr double g = 9.81;

template <int Dof>
struct System {
  Motion<Dof> motion;
  std::vector<FrictionContact> contacts;
  std::vector<Row<Dof>> rows;
  std::vector<Twist<Dof>> V;

  /// The residual of the row, Eq. (4.6) [m/s].
  double lacks(std::size_t k) const {
    const Row<Dof>& row = rows[k];
    return row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]) - row.Sigma * row.lambda;
  }
  Vec2 tangential(const FrictionContact& contact) const {
    return {rows[contact.normal + 1].lambda, rows[contact.normal + 2].lambda};
  }
  Vec2 slip_lacks(const FrictionContact& contact) const {
    return {lacks(contact.normal + 1), lacks(contact.normal + 2)};
  }
  /// The velocity after the step: before, plus the forces' part, plus the rows' part.
  Twist<Dof> velocity(std::size_t body) const { return motion.W[body] + motion.Wf[body] + V[body]; }

  /// Sets a row's λ, and updates V = M⁻¹ Gᵀ λ.
  void begin_with(std::size_t k, double lambda) {
    Row<Dof>& row = rows[k];
    V[row.i] += (lambda - row.lambda) * row.MinvGi;
    V[row.j] += (lambda - row.lambda) * row.MinvGj;
    row.lambda = lambda;
  }
};

template <int Dof>
int add_body(System<Dof>& s, const InverseMass<Dof>& inverse_mass, const Twist<Dof>& W = Twist<Dof>::Zero(),
             const Twist<Dof>& Wf = Twist<Dof>::Zero()) {
  s.motion.inverse_mass.push_back(inverse_mass);
  s.motion.W.push_back(W);
  s.motion.Wf.push_back(Wf);
  s.V.push_back(Twist<Dof>::Zero());
  return static_cast<int>(s.V.size()) - 1;
}

/// Three rows, the friction rows with bounds of ±`bound`. No gap: a = 0, b = 1.
template <int Dof>
void add_contact(System<Dof>& s, const Contact& contact, const Tangents& t, double mu, double Sigma = 0,
                 double Gamma = 0, double bound = infinity) {
  const ContactJacobian G = contact_jacobian(contact);
  s.contacts.push_back({.normal = s.rows.size(), .mu = mu});
  s.rows.push_back(make_row<Dof>({.i = contact.i,
                                  .j = contact.j,
                                  .Gi = G.Gi.template head<Dof>(),
                                  .Gj = G.Gj.template head<Dof>(),
                                  .gap = 0,
                                  .spook = {.a = 0, .b = 1, .Sigma = Sigma}},
                                 s.motion));
  for (const Constraint<Dof>& row :
       friction_constraints<Dof>(contact, t, bound, {.a = 0, .b = 1, .Sigma = Gamma}))
    s.rows.push_back(make_row(row, s.motion));
}

inline Tangents turned(const Vec3& n, double angle) {
  const Tangents t = tangents(n);
  const Vec3 t1 = std::cos(angle) * t.t1 + std::sin(angle) * t.t2;
  return {.t1 = t1, .t2 = n.cross(t1)};
}

inline Contact random_contact(Random& random, int bodies) {
  const int i = random.integer(0, bodies - 1);
  return {.i = i,
          .j = (i + random.integer(1, bodies - 1)) % bodies,
          .n = random.unit_vector(),
          .gap = 0,
          .r_i = random.vector(),
          .r_j = random.vector()};
}

/// Returns moving rigid bodies without rows.
inline System<6> random_bodies(Random& random, int bodies) {
  System<6> s;
  for (int k = 0; k < bodies; ++k) {
    const InverseMass<6> inverse_mass = random_body(random);
    const Vec3 v = random.vector(), omega = random.vector();
    add_body(s, inverse_mass, (Twist<6>() << v, omega).finished());
  }
  return s;
}

inline void add_random_contact(System<6>& s, Random& random, double mu) {
  const Contact contact = random_contact(random, static_cast<int>(s.V.size()));
  const Tangents t = turned(contact.n, random.uniform(0, 6));
  const double Sigma = random.uniform(0.05, 0.2);
  add_contact(s, contact, t, mu, Sigma, random.uniform(0, 0.1));
}

/// Adds a row of a joint, without bounds.
inline void add_random_joint(System<6>& s, Random& random) {
  const Contact at = random_contact(random, static_cast<int>(s.V.size()));
  const ContactJacobian G = contact_jacobian(at);
  s.rows.push_back(make_row<6>({.i = at.i,
                                .j = at.j,
                                .Gi = G.Gi,
                                .Gj = G.Gj,
                                .gap = 0,
                                .spook = {.a = 0, .b = 1, .Sigma = random.uniform(0.05, 0.2)},
                                .lo = -infinity,
                                .hi = infinity},
                               s.motion));
}

/// FrictionContact contacts among bodies that move, with a joint's row before, between and after them.
inline System<6> random_system(Random& random, int bodies, int contacts, double largest_mu) {
  System<6> s = random_bodies(random, bodies);
  for (int k = 0; k < contacts; ++k) {
    add_random_joint(s, random);
    add_random_contact(s, random, random.uniform(0.2, 1) * largest_mu);
  }
  add_random_joint(s, random);
  return s;
}

/// n points of 1 kg at rest on a slope, each on the one before; t1 is turned from downhill by `turn`.
inline System<3> points_on_a_slope(int n, double slope, double mu, double turn, double h) {
  System<3> s;
  add_body<3>(s, {});
  const Vec3 up = Vec3::UnitZ(), t1(std::cos(turn), std::sin(turn), 0), zero = Vec3::Zero();
  const Vec3 Wf = h * g * Vec3(std::sin(slope), 0, -std::cos(slope));
  for (int k = 0; k < n; ++k) {
    const int j = add_body<3>(s, {.linear = 1}, zero, Wf);
    add_contact(s, {.i = j - 1, .j = j, .n = up, .gap = 0, .r_i = zero, .r_j = zero}, {t1, up.cross(t1)}, mu);
  }
  return s;
}

/// A thin rod of 1 kg and 2 m that stands with one end on the floor, its other end ahead (x > 0) and up, with
/// tan 2 of slope: n·Kn = 1.6/kg, n·Kx = -1.2/kg. It is about to fall by `fall` [m/s], and slides at `slip`.
inline System<6> leaning_rod(double mu, double slip, double fall) {
  System<6> s;
  add_body<6>(s, {});
  const Vec3 along = Vec3(1, 0, 2) / std::sqrt(5), zero = Vec3::Zero();
  const Mat3 inverse_inertia = 3 * (Mat3::Identity() - along * along.transpose());
  add_body<6>(s, {.linear = 1, .angular = inverse_inertia}, (Twist<6>() << slip, 0, -fall, zero).finished());
  add_contact(s, {.i = 0, .j = 1, .n = Vec3::UnitZ(), .gap = 0, .r_i = zero, .r_j = -along},
              {Vec3::UnitX(), Vec3::UnitY()}, mu);
  return s;
}
constexpr double rod_Knn = 1.6, rod_Knx = -1.2;  // [1/kg]

/// The stiffest direction of a contact's friction rows, Eq. (9.5), as the larger eigenvalue of their S [1/kg].
template <int Dof>
Eigen::Matrix2d tangential_S(const System<Dof>& s, const FrictionContact& contact) {
  const Row<Dof>&a = s.rows[contact.normal + 1], &b = s.rows[contact.normal + 2];
  const double both = a.Gi.dot(b.MinvGi) + a.Gj.dot(b.MinvGj);
  Eigen::Matrix2d S;
  S << a.diagonal, both, both, b.diagonal;
  return S;
}

inline double larger_eigenvalue(const Eigen::Matrix2d& S) {
  return eigenvalues(S)[1];
}

template <int Dof>
Eigen::VectorXd all_lambda(const std::vector<Row<Dof>>& rows) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) values[static_cast<Eigen::Index>(k)] = rows[k].lambda;
  return values;
}

/// V as one long vector.
template <int Dof>
Eigen::VectorXd all_V(const std::vector<Twist<Dof>>& V) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(Dof * V.size()));
  for (std::size_t k = 0; k < V.size(); ++k) values.segment(static_cast<Eigen::Index>(Dof * k), Dof) = V[k];
  return values;
}

/// M⁻¹ Gᵀ λ, from nothing.
template <int Dof>
Eigen::VectorXd V_of_lambda(const std::vector<Row<Dof>>& rows, std::size_t bodies) {
  std::vector<Twist<Dof>> V(bodies, Twist<Dof>::Zero());
  for (const Row<Dof>& row : rows) {
    V[row.i] += row.lambda * row.MinvGi;
    V[row.j] += row.lambda * row.MinvGj;
  }
  return all_V(V);
}

}  // namespace spook::testing
