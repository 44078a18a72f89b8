// Further tests of chapter 13: Jacobians against differences, turns, limits, motors.
#include "13_mechanisms/mechanisms.hpp"
#include "dense_rows.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(TurnedApart, "13.1 turned_apart");
EXERCISE(ShiftAlong, "13.2 shift_along");
EXERCISE(HingeAngle, "13.3 hinge_angle");
EXERCISE(LimitConstraint, "13.4 limit_constraint");
EXERCISE(MotorRow, "13.5 motor_row");

Quat turned_by(const Vec3& angle) {
  const double size = angle.norm();
  return size > 0 ? Quat(Eigen::AngleAxisd(size, angle / size)) : Quat::Identity();
}

/// A frame after its body has moved with a velocity and an angular velocity for a time.
JointFrame moved(const JointFrame& frame, const Twist<6>& W, double t) {
  const Quat turn = turned_by(t * W.tail<3>());
  return {.at = {.body = frame.at.body, .x = frame.at.x + t * W.head<3>(), .r = turn * frame.at.r},
          .axes = turn * frame.axes};
}

JointFrame any_frame(Random& random, int body) {
  const Vec3 x = random.vector(2), r = random.vector();
  return {.at = {.body = body, .x = x, .r = r}, .axes = random.rotation()};
}

/// The rate by the blocks, and by a difference over 2 t.
void expect_rate(const std::string& equation,
                 const std::function<Coordinate(const JointFrame&, const JointFrame&)>& of) {
  Random random;
  const double t = 1e-5;
  for (int k = 0; k < 20; ++k) {
    const JointFrame i = any_frame(random, 0), j = any_frame(random, 1);
    const Twist<6> Wi = random.twist(), Wj = random.twist();
    const Coordinate now = of(i, j);
    const double rate = now.Gi.dot(Wi) + now.Gj.dot(Wj);
    const double difference =
        (of(moved(i, Wi, t), moved(j, Wj, t)).value - of(moved(i, Wi, -t), moved(j, Wj, -t)).value) / (2 * t);
    expect_near("rate of the coordinate [1/s]", equation, rate, difference,
                {1e-8, "t² of the third derivative, below 100, and round-off over t"});
  }
}

EXERCISE_TEST(ShiftAlong, HasTheRateOfItsJacobian) {
  for (int axis = 0; axis < 3; ++axis)
    expect_rate("Eq. (13.6)",
                [axis](const JointFrame& i, const JointFrame& j) { return shift_along(i, j, axis); });
}

EXERCISE_TEST(TurnedApart, HasTheRateOfItsJacobian) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    expect_rate("Eq. (13.4)",
                [axis](const JointFrame& i, const JointFrame& j) { return turned_apart(i, j)[axis]; });
}

EXERCISE_TEST(HingeAngle, CountsTurnsBothWays) {
  Random random;
  const JointFrame i = any_frame(random, 0);
  for (const double sign : {1.0, -1.0}) {
    double last = 0;
    for (int k = 1; k <= 200; ++k) {
      JointFrame j = i;
      j.at.body = 1;
      j.axes = i.axes * turned_by(Vec3(0, 0, sign * 0.3 * k));
      last = hinge_angle(i, j, last).value;
      expect_near("angle after " + std::to_string(k) + " steps of 0.3 rad [rad]", "Eq. (13.9)", last,
                  sign * 0.3 * k, roundings(100, 60));
    }
  }
}

EXERCISE_TEST(LimitConstraint, TakesTheNearerLimit) {
  Random random;
  Coordinate free{.i = 0, .j = 1, .Gi = random.twist(), .Gj = random.twist(), .value = 0};
  for (const double past : {0.25, -0.25}) {  // before the limit, and beyond it
    free.value = 2 - past;
    const Constraint<6> upper =
        limit_constraint(free, {.lower = -5, .upper = 2}, spook_parameters(0.01, 1e6, 2), 0.01);
    expect_near("gap to the upper limit", "Eq. (13.10)", upper.gap, past, roundings(16, 4));
    expect_near_vector("its block of j", "Eq. (13.10)", upper.Gj, Twist<6>(-free.Gj), {0, "a copy"});
    free.value = -5 + past;
    const Constraint<6> lower =
        limit_constraint(free, {.lower = -5, .upper = 2}, spook_parameters(0.01, 1e6, 2), 0.01);
    expect_near("gap to the lower limit", "Eq. (13.10)", lower.gap, past, roundings(16, 8));
    expect_near_vector("its block of j", "Eq. (13.10)", lower.Gj, free.Gj, {0, "a copy"});
  }
}

EXERCISE_TEST(MotorRow, AsksForItsSpeedWithinItsStrength) {
  Random random;
  Motion<6> motion;
  for (int k = 0; k < 2; ++k) {
    motion.inverse_mass.push_back(random_body(random));
    motion.W.push_back(random.twist());
    motion.Wf.push_back(random.twist());
  }
  const Coordinate free{.i = 0, .j = 1, .Gi = random.twist(), .Gj = random.twist(), .value = 7};
  const double speed = random.uniform(-5, 5), strength = random.log_uniform(0.1, 100), h = 0.02;
  const Row<6> row = motor_row(free, {.speed = speed, .strength = strength}, h, motion);
  const double rate = free.Gi.dot(motion.W[0] + motion.Wf[0]) + free.Gj.dot(motion.W[1] + motion.Wf[1]);
  expect_near("B [m/s or rad/s]", "Eq. (13.13)", row.B, speed - rate, roundings(100, 20));
  expect_near("upper bound", "Eq. (13.13)", row.hi, h * strength, roundings(8, h * strength));
  expect_near("lower bound", "Eq. (13.13)", row.lo, -h * strength, roundings(8, h * strength));
}

}  // namespace
