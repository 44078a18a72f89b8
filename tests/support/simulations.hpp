#pragma once
// Helpers for the tests of steps: bodies of every kind, their units, and the comparison of two simulations.
#include <string>

#include "checks.hpp"
#include "common/simulation.hpp"
#include "random_input.hpp"
#include "units.hpp"

namespace spook::testing {

inline void each_number(Visitor& visitor, RigidBody& body, ByField) {
  using namespace units;
  each_number(visitor, body.x, m), each_number(visitor, body.v, m / s);
  each_number(visitor, body.q, pure), each_number(visitor, body.omega, 1 / s);
  visitor.fixed(true);
  visitor.number(body.mass, kg), each_number(visitor, body.principal, kg * m * m);
  visitor.number(body.radius, m), each_number(visitor, body.half_sides, m);
  each_number(visitor, body.normal, pure), visitor.number(body.offset, m);
  visitor.fixed(false);
}

inline void each_number(Visitor& visitor, PointJoint& joint, ByField) {
  using namespace units;
  visitor.fixed(true);
  visitor.count(joint.i), visitor.count(joint.j);
  each_number(visitor, joint.p_i, m), each_number(visitor, joint.p_j, m);
  visitor.bound(joint.length, m), visitor.bound(joint.k, N / m), visitor.bound(joint.d, pure);
  visitor.fixed(false);
}

inline void each_number(Visitor& visitor, Simulation& all, ByField) {
  using namespace units;
  each_number(visitor, all.bodies, by_field), each_number(visitor, all.joints, by_field);
  visitor.fixed(true);
  each_number(visitor, all.gravity, m / (s * s));
  visitor.bound(all.k, N / m), visitor.bound(all.d, pure);
  visitor.bound(all.mu, pure), visitor.bound(all.viscosity, N * s / m), visitor.bound(all.restitution, pure);
  visitor.count(all.max_sweeps), visitor.bound(all.tolerance, m / s);
  visitor.fixed(false);
}

/// Draws a body that moves and turns, of 1 to 2 kg, with three different moments of inertia.
inline RigidBody random_rigid_body(Random& random) {
  RigidBody body{.x = random.vector(), .v = random.vector(), .q = random.rotation(), .omega = random.vector()};
  body.mass = random.uniform(1, 2);
  body.principal = {random.uniform(0.2, 0.23), random.uniform(0.3, 0.33), random.uniform(0.4, 0.43)};
  return body;
}

/// Draws a static body at rest, whose moments of inertia are those of a dynamic one.
inline RigidBody random_static_body(Random& random) {
  RigidBody body = random_rigid_body(random);
  body.mass = 0;
  body.v = body.omega = Vec3::Zero();
  return body;
}

/// Returns all numbers of the bodies that a step changes.
inline std::vector<double> state_of(const Simulation& all) {
  std::vector<double> numbers;
  for (const RigidBody& body : all.bodies)
    for (const double number :
         {body.x.x(), body.x.y(), body.x.z(), body.v.x(), body.v.y(), body.v.z(), body.q.w(), body.q.x(),
          body.q.y(), body.q.z(), body.omega.x(), body.omega.y(), body.omega.z()})
      numbers.push_back(number);
  return numbers;
}

/// Returns the numbers of one body that a step changes: x, v, q and ω. Of q and -q it takes the one nearer to `near`.
inline Eigen::Matrix<double, 13, 1> state_of(const RigidBody& body, const Quat& near) {
  const double sign = body.q.dot(near) < 0 ? -1 : 1;
  Eigen::Matrix<double, 13, 1> state;
  state << body.x, body.v, sign * body.q.w(), sign * body.q.vec(), body.omega;
  return state;
}

/// Result of a known mistake, and a text about the mistake.
struct Mistake {
  Simulation wrong;
  std::string text;
};

/// Returns true if all bodies of two simulations agree within `close`.
inline bool are_alike(const Simulation& a, const Simulation& b, double close) {
  for (std::size_t k = 0; k < a.bodies.size(); ++k)
    if (!((state_of(a.bodies[k], b.bodies[k].q) - state_of(b.bodies[k], b.bodies[k].q)).norm() <= close))
      return false;
  return true;
}

/// Expects the same positions, velocities, orientations and angular velocities. A failure shows the first body that
/// differs, and names a mistake if its simulation agrees with `got`.
inline void expect_same_bodies(const std::string& what, const std::string& equation, const Simulation& got,
                               const Simulation& expected, const Tolerance& tolerance,
                               const std::vector<Mistake>& mistakes = {}, const std::string& otherwise = "") {
  expect_true("as many bodies as before " + what, equation, got.bodies.size() == expected.bodies.size(),
              "A step neither adds nor removes a body.");
  if (got.bodies.size() != expected.bodies.size() || are_alike(got, expected, tolerance.value)) return;
  const double close = 100 * tolerance.value;
  std::string clue = otherwise;
  for (const Mistake& mistake : mistakes)
    if (!are_alike(mistake.wrong, expected, close) && are_alike(got, mistake.wrong, close)) {
      this_failure_has_a_clue_that_fits();
      clue = mistake.text;
      break;
    }
  for (std::size_t b = 0; b < expected.bodies.size(); ++b) {
    const Quat& near = expected.bodies[b].q;
    const auto right = state_of(expected.bodies[b], near), is = state_of(got.bodies[b], near);
    if ((is - right).norm() <= tolerance.value) continue;
    const auto part = [&](const std::string& name, int first, int count) {
      expect_near_vector<Eigen::VectorXd>(name + " of body " + std::to_string(b) + " " + what, equation,
                                          is.segment(first, count), right.segment(first, count), tolerance, {},
                                          clue);
    };
    part("x [m]", 0, 3);
    part("v [m/s]", 3, 3);
    part("q (w, x, y, z)", 6, 4);
    part("ω [rad/s]", 10, 3);
    return;
  }
}

}  // namespace spook::testing
