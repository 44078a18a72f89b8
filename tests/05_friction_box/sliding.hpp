#pragma once
// Planes in any orientation, and blocks that slide on them, for the tests of chapter 05.
#include <string>
#include <vector>

#include "05_friction_box/friction_box.hpp"
#include "random_input.hpp"

namespace spook::testing {

/// Returns tangents of a random plane, in a random direction within it. The tests hold for any choice of
/// tangents.
inline Tangents random_tangents(Random& random) {
  const Mat3 R = random.rotation().toRotationMatrix();
  return {R.col(0), R.col(1)};
}

inline Vec3 normal_of(const Tangents& t) {
  return t.t1.cross(t.t2);
}

/// The direction at an angle φ [rad] from t1.
inline Vec3 heading(const Tangents& t, double phi) {
  return std::cos(phi) * t.t1 + std::sin(phi) * t.t2;
}

/// Returns a contact at the centres of two bodies. Friction does not depend on its gap.
inline Contact contact_between(int i, int j, const Tangents& t) {
  return {.i = i, .j = j, .n = normal_of(t), .gap = -0.01, .r_i = Vec3::Zero(), .r_j = Vec3::Zero()};
}

/// Solves the constraints together. Returns the change of each body's velocity [m/s, rad/s].
template <int Dof>
std::vector<Twist<Dof>> solved(const std::vector<Constraint<Dof>>& constraints, const Motion<Dof>& motion) {
  std::vector<Row<Dof>> rows;
  for (const Constraint<Dof>& constraint : constraints) rows.push_back(make_row(constraint, motion));
  std::vector<Twist<Dof>> V(motion.W.size(), Twist<Dof>::Zero());
  solve(rows, V, {.max_sweeps = 5000, .tolerance = 1e-14});
  return V;
}

/// A point mass, body 1, on a static plane, body 0, that carries its weight. Only motion along the plane
/// remains.
struct Block {
  double m, h;
  std::vector<Constraint<3>> constraints;
  Vec3 v = Vec3::Zero();  ///< half a step behind x [m/s]
  Vec3 x = Vec3::Zero();

  void add(const std::array<Constraint<3>, 2>& friction) {
    constraints.insert(constraints.end(), friction.begin(), friction.end());
  }

  void step(const Vec3& force = Vec3::Zero()) {
    const Vec3 zero = Vec3::Zero(), v_f = h / m * force;
    const Motion<3> motion{
        .inverse_mass = {{.linear = 0}, {.linear = 1 / m}}, .W = {zero, v}, .Wf = {zero, v_f}};
    v += v_f + solved(constraints, motion)[1];
    x += h * v;
  }
};

/// Returns the distance of a body that leapfrog slows from v0 by A h a step, with a half-step start: the sum of
/// its steps. It is v0²/(2A), less A h²/2 times the square of what v0/(A h) is off an integer.
inline double stopping_distance(double v0, double A, double h) {
  const double z = v0 / (A * h), off = z - std::round(z);
  return v0 * v0 / (2 * A) - A * h * h * off * off / 2;
}

}  // namespace spook::testing
