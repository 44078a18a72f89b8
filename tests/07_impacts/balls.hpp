#pragma once
// Point masses that hit each other or a floor, for the tests of resolve_impacts.
#include <cmath>
#include <string>
#include <vector>

#include "01_leapfrog/leapfrog.hpp"
#include "07_impacts/impacts.hpp"
#include "checks.hpp"

namespace spook::testing {

inline Contact contact_along(int i, int j, const Vec3& n) {
  return {.i = i, .j = j, .n = n, .gap = 0, .r_i = 0.5 * n, .r_j = -0.5 * n};
}

/// Balls in a row along x that touch: velocities, and masses if they are not all 1 kg. No forces.
inline Motion<3> row_of_balls(const std::vector<double>& v, const std::vector<double>& masses = {}) {
  Motion<3> motion;
  for (std::size_t k = 0; k < v.size(); ++k) {
    motion.inverse_mass.push_back({.linear = masses.empty() ? 1 : 1 / masses[k]});
    motion.W.emplace_back(v[k], 0, 0);
    motion.Wf.emplace_back(0, 0, 0);
  }
  return motion;
}

/// The contacts of such a row, from the left to the right.
inline std::vector<Contact> contacts_of_row(int balls) {
  std::vector<Contact> contacts;
  for (int k = 0; k + 1 < balls; ++k) contacts.push_back(contact_along(k, k + 1, Vec3::UnitX()));
  return contacts;
}

inline Eigen::VectorXd speeds(const Motion<3>& motion) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(motion.W.size()));
  for (std::size_t k = 0; k < motion.W.size(); ++k) result[static_cast<Eigen::Index>(k)] = motion.W[k].x();
  return result;
}

inline Eigen::VectorXd numbers(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// A ball of 2 kg, dropped at rest onto a fixed floor. Leapfrog: the velocity is half a step behind.
struct Ball {
  double g, h;
  double x;            ///< height [m]
  double tolerance;    ///< the height up to which it touches [m]: roundings decide where it lands exactly
  Motion<3> motion{};  ///< body 0 is the floor, 1 the ball
  int steps = 0;

  Ball(double gravity, double step, double height, double touching = 0)
      : g(gravity), h(step), x(height), tolerance(touching) {
    motion.inverse_mass = {{.linear = 0}, {.linear = 0.5}};
    motion.Wf = {Vec3::Zero(), Vec3(0, 0, -h * g)};
    motion.W = {Vec3::Zero(), half_step_start(Vec3::Zero(), weight(), 0.5, h)};
  }

  Vec3 weight() const { return {0, 0, -2 * g}; }

  /// The velocity at the time of x.
  double v() const { return motion.W[1].z() + motion.Wf[1].z() / 2; }

  /// Returns the height of the present parabola's top. Leapfrog is exact on it for any steps.
  double apex() const { return x + v() * v() / (2 * g); }

  /// Resolves an impact if there is one now. Returns true if there was one.
  bool resolve(double e) {
    if (x > tolerance) return false;
    return resolve_impacts<3>({contact_along(0, 1, Vec3::UnitZ())}, {.restitution = e}, motion).impacts > 0;
  }

  void step() {
    motion.W[1] = kick(motion.W[1], weight(), 0.5, h);
    x = drift(Vec3(0, 0, x), motion.W[1], h).z();
    ++steps;
  }

  double time() const { return steps * h; }
  std::string text() const { return "h = " + show(h) + " s, g = " + show(g) + " m/s²"; }
};

}  // namespace spook::testing
