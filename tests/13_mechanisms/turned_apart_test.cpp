// The relative orientation of two frames: three numbers, their rows, and the freedom of a hinge.
#include "exercise_test.hpp"
#include "frames.hpp"
#include "regions.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(TurnedApart, "13.1 turned_apart");

Vec3 values_of(const std::array<Coordinate, 3>& apart) {
  return {apart[0].value, apart[1].value, apart[2].value};
}

EXERCISE_TEST(TurnedApart, IsZeroWhereBothAreTurnedAlike) {
  RandomFrames t;
  t.j.axes = t.i.axes;
  const auto apart = turned_apart(t.i, t.j);
  expect_near_vector("relative orientation of two equal frames [rad]", "Eq. (13.3)", values_of(apart),
                     Vec3::Zero(), roundings(16), {},
                     "Q of (13.1) is (1, 0, 0, 0) here, for any direction of the two frames.");
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = t.i.axes * Vec3::Unit(k), got = apart[static_cast<std::size_t>(k)].Gj.tail<3>();
    expect_near_vector(
        "angular block Gj of axis " + std::to_string(k + 1) + ", equal frames", "Eq. (13.4)", got, axis,
        roundings(16),
        {{-axis, "The sign: j comes with a plus, i with a minus."},
         {axis / 2, "This is a half of it: g is 2v, and the ½ of the quaternion's rate cancels the 2."},
         {2 * axis, "This is twice as much. The ½ of dQ/dt = ½ u Q is missing."},
         {Vec3::Unit(k),
          "This is the axis in the joint's own coordinates. Rows are in world coordinates: turn it by P_i."}},
        "With w = 1 and v = 0 a_k is the k-th axis of i's frame, in the world.");
  }
}

EXERCISE_TEST(TurnedApart, IsTheAngleOfASmallTurn) {
  RandomFrames t;
  const double angle = 1e-3;
  for (int k = 0; k < 3 && !::testing::Test::HasFailure(); ++k) {
    const Vec3 e = Vec3::Unit(k);
    t.j.axes = t.i.axes * turn_about(e, angle);
    const Vec3 expected = 2 * std::sin(angle / 2) * e;
    expect_near_vector(
        "relative orientation for j turned by 0.001 rad about axis " + std::to_string(k + 1) + " [rad]",
        "Eq. (13.1), (13.3)", values_of(turned_apart(t.i, t.j)), expected, roundings(32),
        {{expected / 2, "This is v, half of it: v has the sine of half the angle. The gap is 2v."},
         {-expected, "The sign: this is how i is turned as seen from j. Q is P_i* P_j."},
         {2 * t.i.axes.toRotationMatrix() * (std::sin(angle / 2) * e),
          "This is in world coordinates, by P_j P_i*. The joint's axes turn with i: Q is P_i* P_j."}},
        "The part v of Q = P_i* P_j is (half the angle) times the axis, and g is 2v.");
  }
  if (::testing::Test::HasFailure()) return;
  t.i.axes = Quat::Identity();
  t.j.axes = Quat(0, 0, 0, 1);  // w is 0
  expect_near_vector("relative orientation for j turned by half a turn about axis 3 [rad]", "Eq. (13.3)",
                     Vec3(values_of(turned_apart(t.i, t.j)).cwiseAbs()), Vec3(0, 0, 2), {0, "exact"},
                     {{Vec3::Zero(), "Half a turn is not a closed joint: with w = 0 the gap is 2v as well."}},
                     "g_k = 2 v_k for every w.");
}

// The rows against the returned values, not against values of the test's own.
EXERCISE_TEST(TurnedApart, TimesVelocityIsTheirRate) {
  RandomFrames t;
  Regions regions({"w below 0", "w above 0", "nearly equal frames", "frames turned far apart"});
  while (regions.lack_draws()) {
    t.i.axes = t.random.rotation();
    t.j.axes =
        t.random.integer(0, 2) ? t.random.rotation() : t.i.axes * turn_about(t.random.unit_vector(), 0.05);
    const auto apart = turned_apart(t.i, t.j);
    const double w = (t.i.axes.conjugate() * t.j.axes).w();
    regions.draw({{"w below 0", w < 0},
                  {"w above 0", w > 0},
                  {"nearly equal frames", std::abs(w) > 0.999},
                  {"frames turned far apart", std::abs(w) < 0.9}});
    const Twist<6> Wi = t.random.twist(), Wj = t.random.twist();
    const Vec3 u = t.i.axes.conjugate() * Vec3(Wj.tail<3>() - Wi.tail<3>());
    const Vec3 u_in_j = t.j.axes.conjugate() * Vec3(Wj.tail<3>() - Wi.tail<3>());
    const Quat Q = t.i.axes.conjugate() * t.j.axes;
    expect_near_vector(
        "relative orientation of two frames, w = " + show(w) + " [rad]", "Eq. (13.1), (13.3)", values_of(apart),
        Vec3(2 * Q.vec()), roundings(32, 2),
        {{Vec3(-2 * Q.vec()), w < 0 ? "The sign has been turned where w is negative. The gap is 2v of Q, "
                                      "unchanged: its row (13.4) has the w and the v of this same Q."
                                    : "The sign: this is how i is turned as seen from j. Q is P_i* P_j."}},
        "g is 2v, with the v of Q = P_i* P_j, unchanged.");
    if (::testing::Test::HasFailure()) return;
    Vec3 got, rate;
    for (int k = 0; k < 3; ++k) {
      const auto value = [k](const JointFrame& i, const JointFrame& j) {
        return turned_apart(i, j)[static_cast<std::size_t>(k)].value;
      };
      got[k] = rate_by(apart[static_cast<std::size_t>(k)], Wi, Wj);
      rate[k] = rate_of(value, t, Wi, Wj);
    }
    Vec3 by_unit_axes = rate;
    for (int k = 0; k < 3; ++k)
      by_unit_axes[k] /= (Q.w() * Vec3::Unit(k) + Q.vec().cross(Vec3::Unit(k))).norm();
    expect_near_vector(
        "G W, against the values of two rotating bodies, differentiated numerically [rad/s]",
        "Eq. (13.2), (13.4)", got, rate, of_differences,
        {{u, "This is u alone, right only for equal frames. (13.4) has w and v in it."},
         {Vec3(Q.w() * u), "The part v × e_k is missing from a_k."},
         {Vec3(Q.w() * u - u.cross(Q.vec())), "The sign of the cross product: e_k·(u × v) is u·(v × e_k)."},
         {Vec3(u + u.cross(Q.vec())), "The w is missing from a_k."},
         {Vec3(Q.w() * u_in_j + u_in_j.cross(Q.vec())),
          "P_j has turned a_k into the world. Q is the orientation of j in i's frame, so it is P_i that turns "
          "a_k."},
         {Vec3(-rate), w < 0
                           ? "The sign of w has been dropped: where w is negative the value goes the other way."
                           : "The sign: j comes with a plus, i with a minus."},
         {Vec3(rate / 2), "This is the rate of v. The gap is 2v."},
         {Vec3(2 * rate), "The ½ of dQ/dt = ½ u Q is missing."},
         {by_unit_axes, "The a_k have been normalised: they are shorter where the two are turned apart."}},
        "The rate of 2v is w u + u × v, with u = P_i* (ω_j - ω_i).");
  }
}

EXERCISE_TEST(TurnedApart, IsATorqueAndNoForce) {
  const RandomFrames t;
  for (const Coordinate& c : turned_apart(t.i, t.j)) {
    expect_pure_torque("a row of what turns", "Eq. (13.4)", c);
    expect_between("a row of what turns", c, t);
  }
}

EXERCISE_TEST(TurnedApart, LeavesAHingeItsAngle) {
  // About the third axis by any angle: the first two values stay zero, and their rows have no part along it.
  RandomFrames t;
  const Vec3 axis = t.i.axes * Vec3::UnitZ();
  for (const double angle : {0.3, -1.2, 2.9, 3.5, -6.0}) {
    t.close_hinge(angle);
    const auto apart = turned_apart(t.i, t.j);
    for (int k = 0; k < 2; ++k) {
      const Coordinate& c = apart[static_cast<std::size_t>(k)];
      const std::string of = " of a hinge at " + show(angle) + " rad, across its axis";
      expect_near("value" + of + " [rad]", "Eq. (13.3)", c.value, 0, roundings(32));
      const Vec3 a = c.Gj.tail<3>(),
                 halfway = t.i.axes * (turn_about(Vec3::UnitZ(), angle / 2) * Vec3::Unit(k));
      expect_near("part along the axis" + of, "Eq. (13.4)", a.dot(axis), 0, roundings(32), {},
                  "A hinge would not turn freely.");
      expect_near_vector(
          "angular block Gj" + of, "Eq. (13.4)", a, halfway, roundings(64),
          {{Vec3(t.i.axes * Vec3::Unit(k)),
            "This is i's axis. The correct one is halfway between i's and j's."},
           {Vec3(t.j.axes * Vec3::Unit(k)),
            "This is j's axis. The correct one is halfway between i's and j's."},
           {Vec3(-halfway),
            "The sign of w has been dropped: beyond half a turn w is negative, and so is the value."}},
          "w e_k + v × e_k is e_k turned by half the angle of the hinge.");
    }
  }
}

EXERCISE_TEST(TurnedApart, DropsNothingSmall) {
  for (const double part : relative_scales) {
    JointFrame i{{.body = 0, .x = Vec3::Zero()}, Quat::Identity()}, j = i;
    j.axes = turn_about(Vec3::UnitY(), part);
    expect_near("relative orientation for j turned by " + show(part) + " rad about axis 2 [rad]", "Eq. (13.3)",
                turned_apart(i, j)[1].value, 2 * std::sin(part / 2), roundings(4, part),
                {{0, "The turn was treated as 0. " + small_is_dropped}}, small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
