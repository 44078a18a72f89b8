// The angle of a hinge: its sign, its turns, and its row.
#include "exercise_test.hpp"
#include "frames.hpp"
#include "regions.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(HingeAngle, "13.3 hinge_angle");

constexpr double turn = 2 * 3.14159265358979323846;

double angle_at(double angle, double last) {
  RandomFrames t;
  t.close_hinge(angle);
  return hinge_angle(t.i, t.j, last).value;
}

EXERCISE_TEST(HingeAngle, IsTheTurnOfJRelativeToI) {
  for (const double angle : {0.0, 0.3, -0.3, 1.5, -2.0, 3.1, -3.1})
    expect_near("angle of a hinge that is turned by " + show(angle) + " rad, last seen at 0", "Eq. (13.8)",
                angle_at(angle, 0), angle, roundings(64),
                {{std::abs(angle), "The sign is lost, as the cosine alone does not have it. atan2 uses both."},
                 {-angle, "The sign: this is how i is turned as seen from j."},
                 {angle / 2, "This is half of it: w and v_3 are cosine and sine of half the angle."},
                 {2 * std::sin(angle / 2), "This is 2v_3, the chord. The angle is 2 atan2(v_3, w)."}},
                "θ = 2 atan2(v_3, w), with Q = P_i* P_j.");
}

EXERCISE_TEST(HingeAngle, GoesOnBeyondHalfATurn) {
  for (const double sign : {1.0, -1.0}) {
    const double last = sign * 3.1, angle = sign * 3.2;
    expect_near("angle of a hinge last seen at " + show(last) + " rad, at " + show(angle) + " rad",
                "Eq. (13.9)", angle_at(angle, last), angle, roundings(64),
                {{angle - sign * turn,
                  "A turn is missing: at half a turn the angle has jumped to the other side. Of the equivalent "
                  "angles take the one nearest to `last`."}},
                "It turned by 0.1 rad since it was last seen, not by almost a turn back.");
  }
}

// Two hinges are read in turn: the angle of one says nothing about the other.
EXERCISE_TEST(HingeAngle, DependsOnTheGivenLastAngleOnly) {
  RandomFrames t;
  t.close_hinge(0.3);
  double before = hinge_angle(t.i, t.j, 0.4).value;
  for (const double turns : {0.0, 3.0, -2.0, 3.0, 0.0, 1000.0, -70000.0}) {
    const double right = 0.3 + turns * turn, got = hinge_angle(t.i, t.j, right + 0.1).value;
    const double nearest = 0.3 + std::round((before - 0.3) / turn) * turn;
    if (nearest != right && std::abs(got - nearest) < 1e-9) this_failure_explains();
    expect_near(
        "angle of a hinge at 0.3 rad, last seen at " + show(right + 0.1) + " rad", "Eq. (13.9)", got, right,
        roundings(64, 20 + std::abs(right)),
        {{nearest, std::string("This is nearest to the result of an earlier call. A static variable? There are "
                               "many hinges: use `last` only.") +
                       (nearest == 0.3 ? " Or are the whole turns of `last` lost? They count." : "")},
         {right + std::round((got - right) / turn) * turn,
          "It is whole turns off. `last` may be any number of turns away, not one or two."}},
        "Of the equivalent angles take the one nearest to `last`.");
    if (::testing::Test::HasFailure()) return;
    before = right;
  }
}

EXERCISE_TEST(HingeAngle, IsTheNearestWhateverTheSignsOfTheQuaternions) {
  RandomFrames t;
  Regions regions({"w below 0", "w above 0", "v_3 below 0", "v_3 above 0", "turns forwards", "turns backwards",
                   "some turns ahead", "some turns back"},
                  10);
  while (regions.lack_draws()) {
    const double angle = t.random.uniform(-40, 40), last = angle + t.random.uniform(-3, 3);
    t.i.axes = t.random.rotation();
    t.close_hinge(angle);
    if (t.random.integer(0, 1)) t.j.axes.coeffs() *= -1;  // the same orientation
    const Quat Q = t.i.axes.conjugate() * t.j.axes;
    regions.draw({{"w below 0", Q.w() < 0},
                  {"w above 0", Q.w() > 0},
                  {"v_3 below 0", Q.z() < 0},
                  {"v_3 above 0", Q.z() > 0},
                  {"turns forwards", angle > last},
                  {"turns backwards", angle < last},
                  {"some turns ahead", angle > turn},
                  {"some turns back", angle < -turn}});
    expect_near("angle of a hinge at " + show(angle) + " rad, last seen at " + show(last) + " rad",
                "Eq. (13.9)", hinge_angle(t.i, t.j, last).value, angle, roundings(64, 40), {},
                "q and -q are the same orientation, so atan2's angle is right except for whole turns of either "
                "sign. Take the angle nearest to `last`.");
  }
}

EXERCISE_TEST(HingeAngle, CountsManyTurns) {
  Random random;
  double angle = 0, last = 0;
  for (int n = 0; n < 300 && !::testing::Test::HasFailure(); ++n) {
    angle += random.uniform(-1.5, 3.1);  // less than half a turn, and forwards on average
    last = angle_at(angle, last);
    expect_near("angle after " + std::to_string(n + 1) + " calls [rad]", "Eq. (13.9)", last, angle,
                roundings(64, 300), {},
                "From call to call it turns by less than half a turn. However many turns it has made already, "
                "the new angle is the one nearest to the last.");
  }
}

EXERCISE_TEST(HingeAngle, IsTheSameForMinusTheQuaternion) {
  RandomFrames t;
  for (const double angle : {0.4, -2.5}) {
    t.close_hinge(angle);
    t.j.axes.coeffs() *= -1;
    expect_near("angle of a hinge at " + show(angle) + " rad, whose j has the quaternion -q",
                "Eq. (13.8), (13.9)", hinge_angle(t.i, t.j, 0).value, angle, roundings(64),
                {{angle + turn, "There is a turn too many: q and -q are the same orientation."},
                 {angle - turn, "There is a turn too few: q and -q are the same orientation."}},
                "q and -q are the same orientation, but 2 atan2 differs by a turn. Subtract it by (13.9).");
  }
}

EXERCISE_TEST(HingeAngle, TimesVelocityIsItsRate) {
  RandomFrames t;
  t.close_hinge(2.1);
  const auto value = [](const JointFrame& i, const JointFrame& j) { return hinge_angle(i, j, 2.1).value; };
  for (int trial = 0; trial < 10 && !::testing::Test::HasFailure(); ++trial) {
    const Twist<6> Wi = t.random.twist(), Wj = t.random.twist();
    const double rate = rate_of(value, t, Wi, Wj);
    expect_near("G W, against the angle of two rotating bodies, differentiated numerically [rad/s]",
                "Eq. (13.8)", rate_by(hinge_angle(t.i, t.j, 2.1), Wi, Wj), rate, of_differences,
                {{-rate, "The sign: j comes with a plus, i with a minus."},
                 {Wj[5] - Wi[5], "This is about the world's z. The axis is the third of i's frame."},
                 {rate / 2, "This is the rate of half the angle."},
                 {(t.i.axes * Vec3::UnitX()).dot(Vec3(Wj.tail<3>() - Wi.tail<3>())),
                  "This is about the frame's first axis. The hinge is along the third."}},
                "The angle's rate is the part of ω_j - ω_i along the axis.");
  }
  expect_pure_torque("the row of an angle", "Eq. (13.8)", hinge_angle(t.i, t.j, 0));
  expect_between("the row of an angle", hinge_angle(t.i, t.j, 0), t);
}

// Q = (opening) (turn about the third axis): atan2(v_3, w) is that of the turn, however far the joint is open.
EXERCISE_TEST(HingeAngle, DoesNotCountTheOpening) {
  RandomFrames t;
  for (int trial = 0; trial < 30 && !::testing::Test::HasFailure(); ++trial) {
    const double angle = t.random.uniform(-3, 3), open = t.random.log_uniform(1e-3, 1.5),
                 where = t.random.uniform(-3, 3), last = angle + t.random.uniform(-3, 3);
    const Quat opening = turn_about(Vec3(std::cos(where), std::sin(where), 0), open);
    t.j.axes = t.i.axes * opening * turn_about(Vec3::UnitZ(), angle);
    if (t.random.integer(0, 1)) t.j.axes.coeffs() *= -1;
    const Quat Q = t.i.axes.conjugate() * t.j.axes;
    const auto nearest = [&](double x) { return x - turn * std::round((x - last) / turn); };
    const double whole = 2 * std::atan2(std::copysign(Q.vec().norm(), Q.z()), Q.w());
    expect_near(
        "angle of a hinge at " + show(angle) + " rad that is open by " + show(open) + " rad, last seen at " +
            show(last) + " rad",
        "Eq. (13.8)", hinge_angle(t.i, t.j, last).value, angle, roundings(256, 4),
        {{nearest(whole),
          "This has |v| in place of v_3, or 2 acos(w), the whole angle of Q: both include the opening of the "
          "hinge."},
         {nearest(2 * std::asin(Q.z() * (Q.w() < 0 ? -1 : 1))),
          "This is 2 asin(v_3), right only where the hinge is closed. Where it is open w² + v_3² is below 1."}},
        "θ = 2 atan2(v_3, w): the opening multiplies both by the same factor.");
  }
}

EXERCISE_TEST(HingeAngle, TurnsAboutTheAxisOfI) {
  // The same for a hinge that is slightly open.
  RandomFrames t;
  t.close_hinge(0.5);
  t.j.axes = t.j.axes * turn_about(Vec3(1, 2, 0), 0.01);
  const Vec3 a = hinge_angle(t.i, t.j, 0).Gj.tail<3>(), axis = t.i.axes * Vec3::UnitZ();
  expect_near_vector(
      "angular block Gj of a hinge that is open by 0.01 rad", "Eq. (13.8)", a, axis, roundings(16),
      {{Vec3(t.j.axes * Vec3::UnitZ()), "This is the third axis of j's frame. n is i's."},
       {Vec3(t.i.axes * (t.i.axes.conjugate() * t.j.axes).vec().normalized()),
        "This is the axis about which Q turns. It is that of the hinge only if the hinge is not open at all."}},
      "n = P_i e_3.");
}

EXERCISE_TEST(HingeAngle, DropsNothingSmall) {
  for (const double part : relative_scales) {
    JointFrame i{{.body = 0, .x = Vec3::Zero()}, Quat::Identity()}, j = i;
    j.axes = turn_about(Vec3::UnitZ(), part);
    expect_near("angle of a hinge at " + show(part) + " rad, last seen at 0 [rad]", "Eq. (13.8)",
                hinge_angle(i, j, 0).value, part, roundings(4, part),
                {{0, "It has not turned. " + small_is_dropped}}, small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
