// The row of a motor: its target speed, its strength, and its independence of the angle.
#include "exercise_test.hpp"
#include "frames.hpp"
#include "regions.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(MotorRow, "13.5 motor_row");

constexpr double motor_step = 0.02;

struct Driven {
  Random random;
  Motion<6> motion;
  Coordinate free{.i = 0, .j = 1, .Gi = random.twist(), .Gj = random.twist(), .value = 100};
  Motor motor{.speed = 1.7, .strength = 3, .viscosity = 40};

  Driven() {
    for (int body = 0; body < 2; ++body) {
      Mat3 A;
      A << random.vector(), random.vector(), random.vector();
      motion.inverse_mass.push_back({.linear = 0.3 + body, .angular = A * A.transpose() + Mat3::Identity()});
      motion.W.push_back(random.twist());
      motion.Wf.push_back(random.twist());
    }
  }
  Row<6> row() const { return motor_row(free, motor, motor_step, motion); }
  double along(const std::vector<Twist<6>>& of) const { return rate_by(free, of[0], of[1]); }
};

EXERCISE_TEST(MotorRow, HasTheMissingSpeedAsItsRightSide) {
  const Driven t;
  const double GW = t.along(t.motion.W), GWf = t.along(t.motion.Wf), w = t.motor.speed;
  expect_near(
      "B of a motor [rad/s]", "Eq. (13.13)", t.row().B, w - GW - GWf, roundings(64, 10),
      {{-GW - GWf, "The wanted speed is missing: without it the motor only brakes."},
       {w - GW, "G W_f, the effect of forces in this step, is missing: a load would always slow it a little."},
       {w, "The present speed is missing: subtract G W."},
       {w + GW + GWf, "The sign: subtract the present speed from the wanted one."},
       {-w - GW - GWf, "The sign of the wanted speed."},
       {motor_step * w - GW - GWf, "This is the angle of a step, h w. The row sets a speed."},
       {w - GW - GWf - t.free.value / motor_step,
        "The angle is corrected, too. A motor has no target angle: a = 0."}},
      "B = w - G W - G W_f.");
}

EXERCISE_TEST(MotorRow, DoesNotLookAtTheAngle) {
  Driven t;
  const double before = t.row().B;
  t.free.value = -3;
  expect_near("B at another angle [rad/s]", "Eq. (13.12)", t.row().B, before, {0, "the same value"}, {},
              "A motor sets a speed, and no angle: a = 0.");
}

EXERCISE_TEST(MotorRow, IsBoundedByItsStrength) {
  Driven t;
  const Row<6> row = t.row();
  const double most = motor_step * t.motor.strength;
  expect_true("a motor of 3 N m has bounds; here hi = " + show(row.hi), "Eq. (13.13)", std::isfinite(row.hi),
              "The motor has no bound: it would reach its speed in one step.");
  expect_near("largest impulse of a motor of 3 N m in 0.02 s [N m s]", "Eq. (13.13)", row.hi, most,
              roundings(4), {{t.motor.strength, "This is the torque. λ is an impulse: in a step it is h T."}},
              "|λ| <= h T.");
  expect_near("smallest impulse [N m s]", "Eq. (13.13)", row.lo, -most, roundings(4),
              {{0, "It cannot brake: a motor pushes both ways."}}, "-h T <= λ.");
  t.motor.strength = infinity;
  expect_true("a motor of any strength has no bounds; here hi = " + show(t.row().hi), "Eq. (13.13)",
              t.row().hi == infinity && t.row().lo == -infinity, "h ∞ is ∞.");
}

EXERCISE_TEST(MotorRow, MayBeAnyMotor) {
  Random random;
  Driven t;
  const double GW = t.along(t.motion.W), GWf = t.along(t.motion.Wf);
  Regions regions({"turns back", "turns forwards", "holds still", "of no strength", "of infinite strength",
                   "of finite strength"});
  while (regions.lack_draws()) {
    const int speed = random.integer(-1, 1), strength = random.integer(0, 2);
    t.motor.speed = speed * random.log_uniform(1e-3, 1e3);
    t.motor.strength = strength == 0 ? 0 : strength == 1 ? infinity : random.log_uniform(1e-3, 1e3);
    regions.draw({{"turns back", speed < 0},
                  {"turns forwards", speed > 0},
                  {"holds still", speed == 0},
                  {"of no strength", strength == 0},
                  {"of infinite strength", strength == 1},
                  {"of finite strength", strength == 2}});
    const Row<6> row = t.row();
    const std::string of = " of a motor with a wanted speed of " + show(t.motor.speed) +
                           " rad/s and a strength of " + show(t.motor.strength) + " N m";
    expect_near("B" + of + " [rad/s]", "Eq. (13.13)", row.B, t.motor.speed - GW - GWf,
                roundings(64, 10 + std::abs(t.motor.speed)), {{-GW - GWf, "The wanted speed is missing."}},
                "B = w - G W - G W_f, for a speed of either sign.");
    const double most = motor_step * t.motor.strength;
    const auto is = [&](double bound, double wanted) {
      return bound == wanted || std::abs(bound - wanted) <= 1e-15 * std::abs(wanted);
    };
    expect_true(
        "bounds" + of + ": from " + show(row.lo) + " to " + show(row.hi) + " N m s", "Eq. (13.13)",
        is(row.lo, -most) && is(row.hi, most),
        "The bounds are -h T and h T. For a motor of no strength these are 0 and 0, and not none at all.");
  }
}

EXERCISE_TEST(MotorRow, LagsByItsTorqueOverItsViscosity) {
  const Driven t;
  expect_near("Σ of a motor of viscosity 40", "Eq. (13.12)", t.row().Sigma, 1 / (motor_step * 40),
              roundings(8, 2),
              {{0, "Σ is missing: the rest of SPOOK's numbers is not used, and Σ = 1/(h c)."},
               {motor_step / 40,
                "This is h/c. At a steady speed S λ = B becomes Σ λ = the difference of speeds, with λ = h T."},
               {1.0 / 40, "The h is missing: λ is an impulse."}},
              "Σ = 1/(h c).");
}

EXERCISE_TEST(MotorRow, IsRigidAtInfiniteViscosity) {
  Driven t;
  t.motor.viscosity = infinity;
  expect_near("Σ of a motor of infinite viscosity", "Eq. (13.12)", t.row().Sigma, 0, {0, "1/∞"}, {},
              "For c = ∞ the formula 1/(h c) gives 0: such a motor keeps its speed under any load. 1e12 is "
              "only the default of `Motor`.");
}

EXERCISE_TEST(MotorRow, IsARowOfTheCoordinate) {
  const Driven t;
  const Row<6> row = t.row();
  expect_near_vector("Gi of the motor's row", "Eq. (13.13)", row.Gi, t.free.Gi, {0, "a copy"}, {}, "Copy Gi.");
  expect_near_vector("Gj of the motor's row", "Eq. (13.13)", row.Gj, t.free.Gj, {0, "a copy"}, {}, "Copy Gj.");
  const double S = t.free.Gi.dot(t.motion.inverse_mass[0].times(t.free.Gi)) +
                   t.free.Gj.dot(t.motion.inverse_mass[1].times(t.free.Gj)) + row.Sigma;
  expect_near("diagonal of the motor's row", "Eq. (4.3)", row.diagonal, S, roundings(64, S), {},
              "make_row of chapter 04 fills it in.");
  expect_near("initial λ", "Eq. (4.1)", row.lambda, 0, {0, "exact"});
  Driven other = t;
  other.free.i = 2, other.free.j = 1;
  other.motion.inverse_mass.push_back(t.motion.inverse_mass[0]);
  other.motion.W.push_back(t.motion.W[0]), other.motion.Wf.push_back(t.motion.Wf[0]);
  expect_true("the row is between bodies 2 and 1", "Eq. (13.13)", other.row().i == 2 && other.row().j == 1,
              "Copy the bodies of the coordinate's row.");
}

EXERCISE_TEST(MotorRow, RejectsMotorsThatMakeNoSense) {
  const Driven t;
  const auto with = [&](const Motor& motor, double step = motor_step) {
    motor_row(t.free, motor, step, t.motion);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {infinity, nan})
    expect_rejects("a speed of " + show(bad), "speed", [&] { with({.speed = bad}); });
  for (const double bad : {-1.0, -1e-12, nan})
    expect_rejects("a strength of " + show(bad), "strength", [&] { with({.strength = bad}); });
  for (const double bad : {0.0, -1.0, nan})
    expect_rejects("a viscosity of " + show(bad), "viscosity", [&] { with({.viscosity = bad}); });
  for (const double bad : {0.0, -0.1, nan})
    expect_rejects("a step of " + show(bad), "h", [&] { with({}, bad); });
  const std::string clue = "Check all arguments, also where a strength of 0 lets the motor do nothing.";
  expect_rejects(
      "a speed of NaN without strength", "speed", [&] { with({.speed = nan, .strength = 0}); }, clue);
  expect_rejects(
      "a viscosity of 0 without strength", "viscosity", [&] { with({.strength = 0, .viscosity = 0}); }, clue);
  expect_rejects(
      "a step of 0 without strength", "h", [&] { with({.strength = 0}, 0); }, clue);
  with({.speed = 1, .strength = 0, .viscosity = infinity});  // all of these are valid
}

// Computed by hand: one row, solved exactly in every step.
EXERCISE_TEST(MotorRow, BringsAFlywheelToSpeed) {
  const double I = 2, T = 0.7, w = 3.1;
  Motion<6> motion{.inverse_mass = {{}, {.linear = 1, .angular = Mat3::Identity() / I}},
                   .W = {Twist<6>::Zero(), Twist<6>::Zero()},
                   .Wf = {Twist<6>::Zero(), Twist<6>::Zero()}};
  const Twist<6> G = velocity_of(Vec3::Zero(), Vec3::UnitZ());
  const Coordinate free{.i = 0, .j = 1, .Gi = -G, .Gj = G, .value = 0};
  for (int n = 1; n <= 700 && !::testing::Test::HasFailure(); ++n) {
    const Row<6> row = motor_row(free, {.speed = w, .strength = T}, motor_step, motion);
    motion.W[1] += std::clamp(row.B / row.diagonal, row.lo, row.hi) * row.MinvGj;
    expect_near("speed of a flywheel after " + std::to_string(n) + " steps [rad/s]", "Eq. (13.14)",
                motion.W[1][5], std::min(n * motor_step * T / I, w), {1e-9, "round-off, and 1/(h c) of 1e-11"},
                {}, "It gains h T/I a step until it has the wanted speed, and then keeps that.");
  }
}

EXERCISE_TEST(MotorRow, DropsNothingSmall) {
  Driven t;
  t.motor.speed = 0;
  const double without = t.row().B;
  for (const double part : relative_scales) {
    t.motor.speed = part;
    expect_near("contribution to B of a wanted speed of " + show(part) + " rad/s [rad/s]", "Eq. (13.13)",
                t.row().B - without, part, roundings(4, without), {{0, "It adds nothing. " + small_is_dropped}},
                small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
