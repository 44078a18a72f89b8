// A point on a massless rod, and a bar on a ball joint, released from the horizontal: period and tension.
#include <numbers>

#include "exercise_test.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(DistanceConstraint, "6.1 distance_constraint");
EXERCISE(BallJointConstraints, "6.2 ball_joint_constraints");

constexpr double stiffness = 1e10;  // stretches by 3 mg/k = 3e-9 m
constexpr double l = 1;

// Eq. (6.13), with K by arithmetic-geometric means: K(k) = π/2 over the mean of 1 and √(1 - k²).
double period(double angle) {
  double a = 1, b = std::cos(angle / 2);
  for (int n = 0; n < 6; ++n) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return 4 * std::sqrt(l / gravity) * std::numbers::pi / 2 / a;
}
const double exact_period = period(std::numbers::pi / 2);  // 2.34524 s

/// Times at which the pendulum is straight below the hook.
class Crossings {
 public:
  /// Takes the positions x before the step to t, and y after it. The hook is at the origin.
  void look(const Vec3& x, const Vec3& y, double t, double h) {
    const double before = std::atan2(x.x(), -x.z()), now = std::atan2(y.x(), -y.z());
    if ((before > 0) != (now > 0)) times_.push_back(t - h * now / (now - before));
  }
  bool done() const { return times_.size() == 3; }
  /// NaN if it has not passed three times.
  double period() const { return done() ? times_[2] - times_[0] : std::nan(""); }

 private:
  std::vector<double> times_;
};

struct Swing {
  double period;
  double tension;  // the largest
};

// 1 kg at 1 m to the right of the hook.
Swing swing_on_a_rod(double h, double d) {
  const SpookParameters spook = spook_parameters(h, stiffness, d);
  Points points;
  points.add(Vec3::Zero(), 0);
  points.add(Vec3(l, 0, 0), 1);
  points.v[1] = half_step_start(Vec3::Zero(), Vec3(0, 0, -gravity), 1, h);
  Crossings crossings;
  double tension = 0;
  for (double t = h; t < 2 * exact_period && !crossings.done(); t += h) {
    const Vec3 before = points.x[1];
    const double lambda =
        points.step({distance_constraint<3>(points.at(0), points.at(1), l, spook)}, h, {.max_sweeps = 1})[0];
    tension = larger(tension, -lambda / h);
    crossings.look(before, points.x[1], t, h);
  }
  return {crossings.period(), tension};
}

// A uniform bar of 1 kg and length 3l/2 that hangs by its end swings like a point at l: I/(m s) = (2/3) 3l/2.
double swing_of_a_bar(double h, double d) {
  const double length = 1.5 * l, s = length / 2;
  const SpookParameters spook = spook_parameters(h, stiffness, d);
  const Attachment hook{.body = 0, .x = Vec3::Zero()};
  std::vector<Rigid> bodies{
      {.inverse_mass = 0, .principal = Vec3::Ones(), .x = Vec3::Zero()},
      {.inverse_mass = 1, .principal = Vec3::Constant(length * length / 12), .x = Vec3(s, 0, 0)}};
  Rigid& bar = bodies[1];
  // Half a step back at the angular acceleration g/l, about +y, as Eq. (1.5) does.
  bar.omega = Vec3(0, -h / 2 * gravity / l, 0);
  bar.v = Vec3(0, 0, h / 2 * gravity / l * s);
  Crossings crossings;
  for (double t = h; t < 2 * exact_period && !crossings.done(); t += h) {
    const Vec3 before = bar.x;
    const auto rows =
        ball_joint_constraints<6>(hook, {.body = 1, .x = bar.x, .r = bar.q * Vec3(-s, 0, 0)}, spook);
    step(bodies, {rows[0], rows[1], rows[2]}, true, h, {.max_sweeps = 1000, .tolerance = 1e-13});
    crossings.look(before, bar.x, t, h);
  }
  return crossings.period();
}

// A step goes along the tangent, which lengthens the rod. SPOOK corrects this over about d steps, so at speed v the rod
// is longer by h² v² (1 + 2d)/(4l). The longer path, and the work of the tension during the lengthening, make the
// period longer by 5/2 (1 + 2d) h² √(g/2l) ∫ √cos θ dθ, where the integral from 0 to π/2 is 1.198. Leapfrog's own error
// has the other sign, and is smaller.
double lateness(double h, double d) {
  return 3 * (1 + 2 * d) * h * h * std::sqrt(gravity / (2 * l));
}

EXERCISE_TEST(DistanceConstraint, SwingsWithTheExactPeriod) {
  const double h = 1e-3;
  for (const double d : {1.0, 3.0, 5.0}) {
    expect_near("period of a pendulum from 90°, l = 1 m, g = 10 m/s², h = 1 ms, d = " + show(d) + " [s]",
                "Eq. (6.13)", swing_on_a_rod(h, d).period, exact_period,
                {lateness(h, d), "3 (1 + 2d) h² √(g/2l), from the gap that a turning rod keeps"},
                {{2 * std::numbers::pi * std::sqrt(l / gravity), "This is the period of small swings."}},
                "It swings at another length, or not at all: does the row also pull, with lo = -∞? NaN: it has "
                "not passed three times within two periods.");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(DistanceConstraint, SwingsWithOrderTwo) {
  expect_order(
      "period of a pendulum from 90°, d = 3, against 2.34524 s", "Eq. (6.13)",
      [](double h) { return std::abs(swing_on_a_rod(h, 3).period - exact_period); }, 0.005, 3, 2, 0.1,
      "The gap that a turning rod keeps is of order h², and the period follows it.");
}

EXERCISE_TEST(DistanceConstraint, PullsThreefoldAtTheBottom) {
  const double h = 1e-3;
  for (const double d : {1.0, 3.0, 5.0}) {
    expect_near(
        "largest tension -λ/h of a pendulum of 1 kg from 90°, h = 1 ms, d = " + show(d) + " [N]", "Eq. (6.7)",
        swing_on_a_rod(h, d).tension, 3 * gravity,
        {(d + 1.25) * h * h * gravity * gravity / l,
         "(d + ½) h² m g²/l from the gap of a turning rod, ¾ h² m g²/l as no step is at the very bottom"},
        {{gravity, "This is its weight. At the bottom add m v²/l = 2 m g."},
         {0, "It never pulls: λ < 0 is a pull, T = -λ/h."}},
        "m g + m v²/l, with v² = 2 g l.");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(BallJointConstraints, SwingsABarWithTheExactPeriod) {
  const double h = 1e-3;
  for (const double d : {1.0, 3.0, 5.0}) {
    expect_near(
        "period of a bar of 1.5 m from 90°, hung by its end, g = 10 m/s², h = 1 ms, d = " + show(d) + " [s]",
        "Eq. (6.6), (6.13)", swing_of_a_bar(h, d), exact_period,
        {lateness(h, d), "that of a rod of 1 m, 3 (1 + 2d) h² √(g/2l): a bar's is smaller"}, {},
        "A bar swings like a point at two thirds of its length. The angular blocks make it turn. The rows also "
        "pull: lo = -∞.");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(BallJointConstraints, SwingsABarWithOrderTwo) {
  expect_order(
      "period of a bar from 90°, hung by its end, d = 1, against 2.34524 s", "Eq. (6.6), (6.13)",
      [](double h) { return std::abs(swing_of_a_bar(h, 1) - exact_period); }, 0.01, 3, 2, 0.1,
      "The gap that a turning bar keeps is of order h², and the period follows it.");
}

}  // namespace
