// Tangents along the slip, and the friction box that they give.
#include "exercise_test.hpp"
#include "friction_systems.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SlidingTangents, "9.1 sliding_tangents");

EXERCISE_TEST(SlidingTangents, FollowTheSlipByHand) {
  const Tangents t = sliding_tangents(Vec3::UnitZ(), Vec3(3, 4, 12), 0.1);
  expect_near_vector(
      "t1 for n = (0, 0, 1), u = (3, 4, 12) m/s", "Eq. (9.2)", t.t1, Vec3(0.6, 0.8, 0), roundings(16),
      {{Vec3(3, 4, 12) / 13, "This is u/|u|. The component of u along n is not slip: subtract it first."},
       {Vec3(3, 4, 0) / 13, "The slip has been divided by |u|. Divide by |u_t|, so that it has length 1."},
       {Vec3(3, 4, 0), "This is u_t itself, in m/s: a tangent has length 1."},
       {Vec3(-0.6, -0.8, 0), "This points against the slip. t1 = u_t/|u_t|: the friction row finds the sign."},
       {Vec3(-0.8, 0.6, 0), "This is n × u_t/|u_t|: the second tangent."}});
  expect_near_vector("t2 for n = (0, 0, 1), u = (3, 4, 12) m/s", "Eq. (9.2)", t.t2, Vec3(-0.8, 0.6, 0),
                     roundings(16),
                     {{Vec3(0.8, -0.6, 0), "The tangents are left-handed: n = t1 × t2 requires t2 = n × t1."},
                      {Vec3(-4, 3, 0), "A tangent has length 1."}});
}

/// Unit vectors at right angles, and right-handed.
void expect_frame(const std::string& when, const Vec3& n, const Tangents& t, const std::string& clue) {
  Mat3 frame;
  frame << t.t1, t.t2, n;
  expect_at_most("deviation of t1, t2 and n from unit vectors at right angles, " + when, "Eq. (5.1), (9.2)",
                 (frame.transpose() * frame - Mat3::Identity()).norm(), roundings(32).value, "32 roundings",
                 clue);
  expect_near_vector("t1 × t2, " + when, "Eq. (5.1)", Vec3(t.t1.cross(t.t2)), n, roundings(32),
                     {{-n, "The tangents are left-handed: n = t1 × t2 requires t2 = n × t1."}}, clue);
}

EXERCISE_TEST(SlidingTangents, FollowAnySlipAcrossAnyNormal) {
  Random random;
  for (int trial = 0; trial < 200 && !::testing::Test::HasFailure(); ++trial) {
    const Vec3 n = random.unit_vector(), u = random.vector(3), u_t = u - n.dot(u) * n;
    if (u_t.norm() < 0.1) continue;
    const Tangents t = sliding_tangents(n, u, 1e-3);
    expect_near_vector("t1 for u = " + show(Eigen::MatrixXd(u)) + " m/s", "Eq. (9.2)", t.t1,
                       Vec3(u_t.normalized()), roundings(32, u.norm() / u_t.norm()), {},
                       "The direction of what u has across n.");
    expect_frame("random n and u", n, t, "t1 along the slip, t2 = n × t1.");
  }
}

// Where nearly all of u is along n, its part across n carries roundings of the whole: 1e-16 of u against 1e-9 of u.
EXERCISE_TEST(SlidingTangents, StayAcrossTheNormalWhenMostOfUIsAlongIt) {
  Random random;
  for (int trial = 0; trial < 50 && !::testing::Test::HasFailure(); ++trial) {
    const Vec3 n = random.unit_vector();
    const double slip = random.log_uniform(1e-9, 1e-6);
    const Tangents t = sliding_tangents(n, 10 * n + slip * tangents(n).t1, 1e-12);
    expect_frame(
        "u = 10 m/s along n and " + show(slip) + " m/s across it", n, t,
        "u - n (n·u) is across n up to a rounding of u, which is large beside a small slip. Subtract the "
        "component of t1 along n once more.");
  }
}

EXERCISE_TEST(SlidingTangents, TakeAnyWhereNothingSlides) {
  Random random;
  const std::string clue =
      "A slip of 0, or of round-off, has no direction. If |u_t| is at most `slow`, use chapter 05's tangents.";
  // Along the axes, where u - (n·u) n is 0 exactly; and anywhere, where it is roundings. Those may lie along n, too:
  // a `slow` of 0 would say that they have a direction.
  const Vec3 anywhere = random.unit_vector();
  std::vector<Tangents> before;
  for (const Vec3& n : {Vec3(0, 0, 1), Vec3(0, -1, 0), Vec3(1, 0, 0), anywhere})
    for (const double slow : {n == anywhere ? 1e-14 : 0.0, 1e-6}) {
      const std::string with = ", n = " + show(n) + ", slow = " + show(slow) + " m/s";
      const Tangents got = sliding_tangents(n, Vec3::Zero(), slow);
      const bool kept = std::any_of(before.begin(), before.end(),
                                    [&](const Tangents& old) { return got.t1 == old.t1 && got.t2 == old.t2; });
      if (kept) this_failure_explains();
      expect_frame(
          "u = 0" + with, n, got,
          kept ? "These are the tangents of another normal: are they kept in a static variable?" : clue);
      if (slow > 0) before.push_back(got);
      expect_frame("u = -5 m/s along n" + with, n, sliding_tangents(n, -5 * n, slow), clue);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(SlidingTangents, FollowAsSoonAsItIsNotSlow) {
  Random random;
  for (const double slow : {0.0, 1e-12, 1e-6, 1e-3, 2.0}) {
    const Vec3 n = random.unit_vector();
    const Tangents across = turned(n, random.uniform(0, 6));
    const double slip = slow > 0 ? 1.1 * slow : 1e-15;
    const Vec3 u = slip * across.t1;
    expect_near_vector(
        "t1 for a slip of " + show(slip) + " m/s, slow = " + show(slow) + " m/s", "Eq. (9.2)",
        sliding_tangents(n, u, slow).t1, across.t1, roundings(32),
        {{tangents(n).t1,
          "These are chapter 05's tangents, although the slip is more than `slow`. Compare |u_t| with `slow` "
          "itself, not with its square or another threshold."}});
  }
}

EXERCISE_TEST(SlidingTangents, DropNothingSmall) {
  for (const double part : relative_scales)
    for (int c = 0; c < 3; ++c) {
      const Vec3 n = Vec3::Unit(c), slip = Vec3::Unit((c + 1) % 3) + part * Vec3::Unit((c + 2) % 3);
      const Tangents t = sliding_tangents(n, slip - 2 * n, 0);
      expect_each_near<Vec3>("t1 of a slip that is nearly along an axis", "Eq. (9.2)", t.t1, slip.normalized(),
                             16);
      expect_each_near<Vec3>("t2 of a slip that is nearly along an axis", "Eq. (9.2)", t.t2,
                             n.cross(slip.normalized()), 16);
      const Vec3 slow = sliding_tangents(n, part * slip - n, 0).t1,
                 fast = sliding_tangents(n, slip - part * n, 0).t1;
      expect_each_near<Vec3>("t1 of a slip that is slow beside the approach", "Eq. (9.2)", slow,
                             slip.normalized(), 16);
      expect_each_near<Vec3>("t1 of a slip that is fast beside the approach", "Eq. (9.2)", fast,
                             slip.normalized(), 16);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(SlidingTangents, StopABlockAtTheSameDistanceInEveryDirection) {
  Random random;
  const double h = 0.001, m = 2, A = 5, v0 = 1.0;  // A = μ g; it takes 200 steps
  for (int trial = 0; trial < 10 && !::testing::Test::HasFailure(); ++trial) {
    const Vec3 n = random.unit_vector();
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const Vec3 heading = turned(n, angle).t1;
    Vec3 x = Vec3::Zero(), v = (v0 + A * h / 2) * heading;  // half a step early
    for (int step = 0; step < 300; ++step) {
      v += friction_impulse(Mat3::Identity() / m, v, sliding_tangents(n, v, 1e-9), 0, m * A * h) / m;
      x += h * v;
    }
    const double reach = v0 * v0 / (2 * A);
    expect_near_vector(
        "where a block stops that starts at an angle of " + show(angle) +
            " to chapter 05's t1, in units of v0²/(2μg)",
        "Eq. (9.2), (5.10)", Vec3(x / reach), heading, {1e-9, "roundings of 300 steps"}, {},
        "With t1 along the slip, the box is as strong in every direction: v0²/(2μg), and straight.");
  }
}

}  // namespace
