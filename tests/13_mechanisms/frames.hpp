#pragma once
// Two bodies with a joint between them, with random positions and motions, and their state a little later.
#include "13_mechanisms/mechanisms.hpp"
#include "checks.hpp"
#include "random_input.hpp"

namespace spook::testing {

/// `linear`, then `angular`.
inline Twist<6> velocity_of(const Vec3& linear, const Vec3& angular) {
  return (Twist<6>() << linear, angular).finished();
}

/// Turns by an angle about an axis.
inline Quat turn_about(const Vec3& axis, double angle) {
  return Quat(Eigen::AngleAxisd(angle, axis.normalized()));
}

/// A frame a time t later, when its body moves and turns with velocity W.
inline JointFrame later(double t, const JointFrame& frame, const Twist<6>& W) {
  const Vec3 v = W.head<3>(), omega = W.tail<3>();
  const Quat turn = turn_about(omega, t * omega.norm());
  return {{.body = frame.at.body, .x = frame.at.x + t * v, .r = turn * frame.at.r}, turn * frame.axes};
}

/// Points 1 to 2 m from each other, and independent axes.
struct RandomFrames {
  Random random;
  JointFrame i{{.body = 4, .x = random.vector(), .r = random.vector()}, random.rotation()};
  JointFrame j{{.body = 2, .x = Vec3::Zero(), .r = random.vector()}, random.rotation()};
  Vec3 apart = random.vector_of_length(1, 2);  ///< from i's point to j's

  RandomFrames() { j.at.x = i.at.x + i.at.r + apart - j.at.r; }

  /// Turns i's axes about i's third by an angle and assigns them to j: a closed hinge.
  void close_hinge(double angle) { j.axes = i.axes * turn_about(Vec3::UnitZ(), angle); }

  /// The size of the terms of a shift [m].
  double size() const { return i.at.x.norm() + i.at.r.norm() + j.at.x.norm() + j.at.r.norm(); }
};

/// The rate of a coordinate, by differences over 2 dt, when the two bodies move with Wi and Wj.
template <class Value>
double rate_of(const Value& value, const RandomFrames& t, const Twist<6>& Wi, const Twist<6>& Wj) {
  const double dt = 1e-5;
  return (value(later(dt, t.i, Wi), later(dt, t.j, Wj)) - value(later(-dt, t.i, Wi), later(-dt, t.j, Wj))) /
         (2 * dt);
}
inline const Tolerance of_differences = {
    3e-8, "dt²/6 times third derivatives, and round-off of 32 units of 6, over dt"};

inline double rate_by(const Coordinate& c, const Twist<6>& Wi, const Twist<6>& Wj) {
  return c.Gi.dot(Wi) + c.Gj.dot(Wj);
}

inline void expect_between(const std::string& what, const Coordinate& c, const RandomFrames& t) {
  expect_true(what + " is between body " + std::to_string(t.i.at.body) + " as i and body " +
                  std::to_string(t.j.at.body) + " as j; here i = " + std::to_string(c.i) +
                  ", j = " + std::to_string(c.j),
              "Eq. (13.4)", c.i == t.i.at.body && c.j == t.j.at.body,
              "Copy the bodies of the two frames, in that order.");
}

/// Checks that a row has opposite torques and nothing else.
inline void expect_pure_torque(const std::string& what, const std::string& equation, const Coordinate& c) {
  expect_near_vector("linear blocks of " + what, equation,
                     Vec3(c.Gi.head<3>().cwiseAbs() + c.Gj.head<3>().cwiseAbs()), Vec3::Zero(), {0, "exact"},
                     {}, "A translation does not change how a body is turned: the linear blocks are zero.");
  expect_near_vector(
      "Gi + Gj of " + what, equation, Twist<6>(c.Gi + c.Gj), Twist<6>::Zero(), {0, "exact"},
      {{Twist<6>(2 * c.Gj), "Gi and Gj are alike. The torque on i is opposite to that on j: -a on i."}},
      "Action equals reaction: a on j, -a on i.");
}

}  // namespace spook::testing
