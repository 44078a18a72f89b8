// The shift of one body along another: the value, its row, and the term that the notes leave out.
#include "exercise_test.hpp"
#include "frames.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(ShiftAlong, "13.2 shift_along");

EXERCISE_TEST(ShiftAlong, MeasuresAlongAnAxisOfI) {
  const RandomFrames t;
  for (int axis = 0; axis < 3 && !::testing::Test::HasFailure(); ++axis) {
    const Vec3 n = t.i.axes * Vec3::Unit(axis);
    const double shift = n.dot(t.apart), centres = n.dot(t.j.at.x - t.i.at.x);
    expect_near(
        "shift along axis " + std::to_string(axis) + " [m]", "Eq. (13.5)", shift_along(t.i, t.j, axis).value,
        shift, roundings(64, t.size()),
        {{-shift, "The sign: d goes from i's point to j's."},
         {t.apart.norm(), "This is the distance. The shift is its part along n."},
         {t.apart[axis], "This is along an axis of the world. n is an axis of the joint, and turns with i."},
         {(t.j.axes * Vec3::Unit(axis)).dot(t.apart), "This is along j's axis. n is fixed to i."},
         {centres, "This is from centre to centre. The points are at x + r."},
         {(t.i.axes.conjugate() * Vec3::Unit(axis)).dot(t.apart),
          "The rotation is the inverse: n is P_i e, not P_i* e."}},
        "g = n·d with n = P_i e and d = p_j - p_i.");
  }
}

EXERCISE_TEST(ShiftAlong, HasFourBlocks) {
  const RandomFrames t;
  for (int axis = 0; axis < 3 && !::testing::Test::HasFailure(); ++axis) {
    const Coordinate c = shift_along(t.i, t.j, axis);
    const Vec3 n = t.i.axes * Vec3::Unit(axis), r_i = t.i.at.r, r_j = t.j.at.r;
    expect_near_vector("Gj along axis " + std::to_string(axis), "Eq. (13.6)", c.Gj,
                       velocity_of(n, r_j.cross(n)), roundings(32, 2),
                       {{velocity_of(-n, -r_j.cross(n)), "The sign: the shift is that of j, so j has a plus."},
                        {velocity_of(n, Vec3::Zero()), "The angular block is missing: its point turns with j."},
                        {velocity_of(n, -r_j.cross(n)), "The sign of the angular block: it is r_j × n."},
                        {velocity_of(n, (r_j - t.apart).cross(n)),
                         "d belongs to i, whose axis turns with it. j's lever arm is r_j."}},
                       "Gj = (n, r_j × n).");
    const Vec3 short_arm = -r_i.cross(n), full = -(r_i + t.apart).cross(n), p_j = t.j.at.x + r_j;
    expect_near_vector(
        "Gi along axis " + std::to_string(axis), "Eq. (13.6)", c.Gi, velocity_of(-n, full), roundings(32, 4),
        {{velocity_of(-n, short_arm),
          "The second term is missing: n turns with i, and the distance d along it is not small."},
         {velocity_of(-n, -(r_i - t.apart).cross(n)), "The sign of the second term: the arm is r_i + d."},
         {velocity_of(-n, -t.apart.cross(n)),
          "r_i is missing: the arm is from i's centre to j's point, r_i + d."},
         {velocity_of(-n, -r_j.cross(n)), "This has the arm of j, r_j. That of i is r_i + d."},
         {velocity_of(-n, -p_j.cross(n)),
          "The arm goes from the origin to j's point. It has to begin at the centre of i: r_i + d."},
         {velocity_of(-n, Vec3::Zero()),
          "The angular block is missing: n turns with i, and so does its point."},
         {velocity_of(n, -full),
          "The impulse on i is opposite to that on j: i is pushed the other way, so both parts of Gi have a "
          "minus."},
         {velocity_of(-n, -full), "The sign of the angular block: both parts of Gi have a minus."}},
        "Gi = (-n, -(r_i + d) × n).");
  }
}

EXERCISE_TEST(ShiftAlong, IncludesAShortOffset) {
  RandomFrames t;
  const Vec3 apart = t.apart;
  for (const double part : relative_scales) {
    t.j.at.x = t.i.at.x + t.i.at.r + part * apart - t.j.at.r;
    const Vec3 d = (t.j.at.x + t.j.at.r) - (t.i.at.x + t.i.at.r);
    for (int axis = 0; axis < 3; ++axis) {
      const Coordinate c = shift_along(t.i, t.j, axis);
      const Vec3 n = t.i.axes * Vec3::Unit(axis), r_i = t.i.at.r;
      expect_near_vector(
          "angular part of Gi, for points that are " + show(d.norm()) + " m apart [m]", "Eq. (13.6)",
          Vec3(c.Gi.tail<3>()), Vec3(-(r_i + d).cross(n)), roundings(16, t.size()),
          {{Vec3(-r_i.cross(n)), "d is missing in the arm, where it is short. " + small_is_dropped}},
          small_is_dropped);
      expect_near("the shift [m]", "Eq. (13.5)", c.value, n.dot(d), roundings(16, t.size()), {},
                  small_is_dropped);
    }
    if (::testing::Test::HasFailure()) return;
  }
}

// The row against the returned value.
EXERCISE_TEST(ShiftAlong, TimesVelocityIsItsRate) {
  RandomFrames t;
  for (int trial = 0; trial < 12 && !::testing::Test::HasFailure(); ++trial) {
    const int axis = trial % 3;
    const Twist<6> Wi = t.random.twist(), Wj = t.random.twist();
    const auto value = [axis](const JointFrame& i, const JointFrame& j) {
      return shift_along(i, j, axis).value;
    };
    const double rate = rate_of(value, t, Wi, Wj);
    const Vec3 n = t.i.axes * Vec3::Unit(axis), omega = Wi.tail<3>();
    expect_near(
        "G W, against the shift of two moving, rotating bodies, differentiated numerically [m/s]", "Eq. (13.6)",
        rate_by(shift_along(t.i, t.j, axis), Wi, Wj), rate, of_differences,
        {{rate - t.apart.dot(omega.cross(n)), "d·(ω_i × n) is missing: the second term of (22) in the notes."}},
        "The points move as v + ω × r, and n as ω_i × n.");
  }
}

EXERCISE_TEST(ShiftAlong, TakesNoMomentum) {
  const RandomFrames t;
  for (int axis = 0; axis < 3; ++axis) {
    const Coordinate c = shift_along(t.i, t.j, axis);
    const Vec3 n = t.i.axes * Vec3::Unit(axis);
    expect_near_vector("sum of the linear blocks", "Eq. (13.6)", Vec3(c.Gi.head<3>() + c.Gj.head<3>()),
                       Vec3::Zero(), roundings(4), {}, "Action equals reaction: n on j, -n on i.");
    const Vec3 torque =
        t.i.at.x.cross(c.Gi.head<3>()) + c.Gi.tail<3>() + t.j.at.x.cross(c.Gj.head<3>()) + c.Gj.tail<3>();
    expect_near_vector("change of angular momentum about the origin by an impulse of 1 N s [kg m²/s]",
                       "Eq. (13.7)", torque, Vec3::Zero(), roundings(64, t.size()),
                       {{Vec3(t.apart.cross(n)),
                         "The change is a torque d × n: the impulse on i acts at i's own point, not at j's. "
                         "The second term moves it there."}},
                       "Both arms end at j's point, so action and reaction are along one line.");
    expect_between("a shift", c, t);
  }
}

// A bead on a rod that turns freely about z, computed by hand: the rod's transverse row is solved exactly in every
// step.
EXERCISE_TEST(ShiftAlong, KeepsTheAngularMomentumOfABeadOnARod) {
  const double I = 1, m = 0.5, h = 1e-3;
  double angle = 0, omega = 2;
  Vec3 x(0.2, 0, 0), v(0, 0.4, 0);
  const double L = I * omega + m * 0.2 * 0.4;
  for (int n = 0; n < 500; ++n) {
    const JointFrame rod{{.body = 0, .x = Vec3::Zero()}, turn_about(Vec3::UnitZ(), angle)};
    const JointFrame bead{{.body = 1, .x = x}, Quat::Identity()};
    const Coordinate c = shift_along(rod, bead, 1);
    const double arm = c.Gi[5];
    const Vec3 along = c.Gj.head<3>();
    const double S = arm * arm / I + along.squaredNorm() / m;
    const double lambda = -(c.value / h + arm * omega + along.dot(v)) / S;
    omega += arm * lambda / I;
    v += along * lambda / m;
    angle += h * omega;
    x += h * v;
  }
  const double kept = I * omega + m * x.cross(v).z();
  expect_near("angular momentum of rod and bead after half a second [kg m²/s]", "Eq. (13.7)", kept, L,
              {500 * 16 * 2.3e-16 * 10 * L, "some units of round-off a step"}, {},
              "The reaction on the rod must act at the bead, not at the rod's own point: use the arm r_i + d.");
}

EXERCISE_TEST(ShiftAlong, DropsNothingSmall) {
  for (const double part : relative_scales) {
    JointFrame i{{.body = 0, .x = Vec3::Zero()}, Quat::Identity()};
    const JointFrame j{{.body = 1, .x = Vec3(1, part, 0)}, Quat::Identity()};
    expect_near("shift along axis 1 of a point at (1, " + show(part) + ", 0) [m]", "Eq. (13.5)",
                shift_along(i, j, 1).value, part, roundings(4, part),
                {{0, "The result is 0. " + small_is_dropped}}, small_is_dropped);
    for (const bool i_is_near : {true, false}) {
      const JointFrame near{{.body = 0, .x = Vec3(part, 0, 0)}, Quat::Identity()},
          far{{.body = 1, .x = Vec3(2, 0, 0)}, Quat::Identity()};
      expect_near("shift of two points, " + show(part) + " m and 2 m from the origin [m]", "Eq. (13.5)",
                  (i_is_near ? shift_along(near, far, 0) : shift_along(far, near, 0)).value,
                  (i_is_near ? 1 : -1) * (2 - part), roundings(4), {}, small_is_dropped);
    }
    i.axes = turn_about(Vec3::UnitZ(), part);
    const Vec3 n = shift_along(i, j, 0).Gj.head<3>();
    expect_near("y of n, an axis that is turned by " + show(part) + " rad about z", "Eq. (13.5)", n.y(),
                std::sin(part), roundings(4, part), {{0, "Its turn was treated as 0. " + small_is_dropped}},
                small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
