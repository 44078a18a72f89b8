// The three rows of a ball joint: gaps, Jacobians, bounds, and the motion of two bodies.
#include "attachments.hpp"
#include "exercise_test.hpp"
#include "relative_scales.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(BallJointConstraints, "6.2 ball_joint_constraints");

const std::vector<std::string> axis_names = {"x", "y", "z"};

std::array<Constraint<6>, 3> rows_between(const RandomPair& t) {
  return ball_joint_constraints<6>(t.i, t.j, t.spook);
}

EXERCISE_TEST(BallJointConstraints, HasThreeGaps) {
  const RandomPair t;
  const auto rows = rows_between(t);
  const Vec3 gaps(rows[0].gap, rows[1].gap, rows[2].gap), apart = t.apart(), centres = t.j.x - t.i.x;
  expect_near_vector(
      "gaps of the rows along x, y, z [m]", "Eq. (6.5)", gaps, apart, roundings(32, t.size()),
      {{-apart, "The sign: g goes from i's point to j's point."},
       {Vec3::Constant(t.distance),
        "This is the distance, three times. A ball joint has a gap along each axis."},
       {t.n, "This is the unit vector. The gaps are p_j - p_i itself, in metres."},
       {apart.cwiseAbs(), "These are absolute values. The sign of the gap decides the sign of λ."},
       {Vec3::Zero(), "The gaps are missing, so the points would stay apart."},
       {centres, "This is from centre to centre. The points are at x + r."},
       {centres + t.j.r, "r_i is missing: both points are beside their body's centre."},
       {centres - t.i.r, "r_j is missing: both points are beside their body's centre."},
       {centres - t.j.r + t.i.r,
        "r goes from the centre to the point, so the point is at x + r. This has x - r."}},
      "g = p_j - p_i, one coefficient a row.");
  const auto exchanged = ball_joint_constraints<6>(t.j, t.i, t.spook);
  expect_near_vector("gaps with i and j exchanged [m]", "Eq. (6.5)",
                     Vec3(exchanged[0].gap, exchanged[1].gap, exchanged[2].gap), Vec3(-apart),
                     roundings(32, t.size()), {}, "Each gap changes its sign, since a gap is not a length.");
}

EXERCISE_TEST(BallJointConstraints, HasARowAlongEachAxis) {
  const RandomPair t;
  const auto rows = rows_between(t);
  const std::string missing = "The angular block is missing: a pull beside the centre also turns the body.";
  const std::string line =
      "This is a row along the line from point to point, as a distance has. A ball joint's rows are along the "
      "axes.";
  const std::string origin =
      "This is the lever arm from the origin. A body turns about its own centre of mass.";
  for (int k = 0; k < 3 && !::testing::Test::HasFailure(); ++k) {
    const Constraint<6>& row = rows[static_cast<std::size_t>(k)];
    const std::string of = " of the row along " + axis_names[static_cast<std::size_t>(k)];
    const Vec3 e = Vec3::Unit(k), torque_i = t.i.r.cross(e), torque_j = t.j.r.cross(e);
    const Vec3 apart = t.j.x + t.j.r - t.i.x - t.i.r;
    expect_near_vector(
        "Gj" + of, "Eq. (6.6)", row.Gj, twist(e, torque_j), roundings(16, 2),
        {{twist(-e, -torque_j), "The sign: the gap is j's point minus i's point, so j has a plus."},
         {twist(e, Vec3::Zero()), missing},
         {twist(e, -torque_j), "The sign of the angular block: it is r_j × e, not e × r_j."},
         {twist(e, torque_i), "This used r_i for body j. Each body has its own lever arm."},
         {twist(e, t.j.r.cwiseProduct(e)),
          "The angular block is a cross product, r_j × e: it has no part along e."},
         {twist(e, (t.j.x + t.j.r).cross(e)), origin},
         {twist(t.n, t.j.r.cross(t.n)), line},
         {twist(e, (t.j.r - apart / 2).cross(e)),
          "This is the arm to the point midway between the two. Use r_i and r_j as they are."}},
        "Gj = (e, r_j × e).");
    expect_near_vector(
        "Gi" + of, "Eq. (6.6)", row.Gi, twist(-e, -torque_i), roundings(16, 2),
        {{twist(e, torque_i), "i is pushed the other way: both parts of Gi have a minus."},
         {twist(-e, Vec3::Zero()), missing},
         {twist(-e, torque_i), "The sign of the angular block: both parts of Gi have a minus."},
         {twist(-e, -torque_j), "This used r_j for body i. Each body has its own lever arm."},
         {twist(-e, -t.i.r.cwiseProduct(e)),
          "The angular block is a cross product, -r_i × e: it has no part along e."},
         {twist(-e, -(t.i.x + t.i.r).cross(e)), origin},
         {twist(-e, -(t.i.r + apart).cross(e)),
          "This arm ends at the point of j, as in (6.15). Here each body has the arm to its own point."},
         {twist(-t.n, -t.i.r.cross(t.n)), line}},
        "Gi = (-e, -r_i × e).");
  }
}

EXERCISE_TEST(BallJointConstraints, HoldsPointsOfAnyKind) {
  RandomPair t;
  std::vector<std::string> names = {"gaps of both signs", "no gap below 0", "no gap above 0"};
  for (const auto& kind : kinds_of(t)) names.push_back(kind.first);
  Regions regions(names);
  while (regions.lack_draws()) {
    t = any_pair(t.random);
    const Vec3 apart = t.apart();
    auto kinds = kinds_of(t);
    kinds.emplace_back("gaps of both signs", apart.minCoeff() < 0 && apart.maxCoeff() > 0);
    kinds.emplace_back("no gap below 0", apart.minCoeff() >= 0);
    kinds.emplace_back("no gap above 0", apart.maxCoeff() <= 0);
    const std::string numbers = given();
    regions.draw(kinds);
    given() = numbers + "\n" + given();
    const auto rows = rows_between(t);
    for (int k = 0; k < 3 && !::testing::Test::HasFailure(); ++k) {
      const Constraint<6>& row = rows[static_cast<std::size_t>(k)];
      const std::string of = " of the row along " + axis_names[static_cast<std::size_t>(k)];
      const Vec3 e = Vec3::Unit(k);
      expect_near("gap" + of + " [m]", "Eq. (6.5)", row.gap, apart[k], roundings(32, t.size()),
                  {{-apart[k], "The sign: g goes from i's point to j's point."}},
                  "g = p_j - p_i, one coefficient a row.");
      expect_near_vector("Gj" + of, "Eq. (6.6)", row.Gj, twist(e, t.j.r.cross(e)), roundings(4, t.size()), {},
                         "Gj = (e, r_j × e).");
      expect_near_vector("Gi" + of, "Eq. (6.6)", row.Gi, twist(-e, -t.i.r.cross(e)), roundings(4, t.size()), {},
                         "Gi = (-e, -r_i × e).");
      expect_pulls_and_pushes("the row along " + axis_names[static_cast<std::size_t>(k)], row);
      expect_carries("the row along " + axis_names[static_cast<std::size_t>(k)], row, t);
    }
  }
}

EXERCISE_TEST(BallJointConstraints, PullsAndPushes) {
  const RandomPair t;
  for (const Constraint<6>& row : rows_between(t)) expect_pulls_and_pushes("a row of a ball joint", row);
}

EXERCISE_TEST(BallJointConstraints, CarriesTheRestOver) {
  const RandomPair t;
  for (const Constraint<6>& row : rows_between(t)) expect_carries("a row of a ball joint", row, t);
}

EXERCISE_TEST(BallJointConstraints, TakesPointMasses) {
  const RandomPair t;
  const auto rows = ball_joint_constraints<3>({.body = 4, .x = t.i.x}, {.body = 2, .x = t.j.x}, t.spook);
  for (int k = 0; k < 3; ++k) {
    const Constraint<3>& row = rows[static_cast<std::size_t>(k)];
    const std::string of = " of point masses, along " + axis_names[static_cast<std::size_t>(k)];
    expect_near("gap" + of + " [m]", "Eq. (6.5)", row.gap, t.j.x[k] - t.i.x[k], roundings(8, t.size()));
    expect_near_vector("Gj" + of, "Eq. (6.6)", row.Gj, Vec3::Unit(k), {0, "exact"});
    expect_near_vector("Gi" + of, "Eq. (6.6)", row.Gi, -Vec3::Unit(k), {0, "exact"});
    expect_pulls_and_pushes("a row of point masses", row);
    expect_carries("a row of point masses", row, t);
  }
}

EXERCISE_TEST(BallJointConstraints, HoldsPointsThatCoincide) {
  // Every number has few binary digits, so that the gaps are 0 exactly.
  const Attachment i{.body = 0, .x = Vec3(1, 2, 3), .r = Vec3(0.5, 0, -0.25)};
  const Attachment j{.body = 1, .x = Vec3(2, 2, 3), .r = Vec3(-0.5, 0, -0.25)};
  const auto rows = ball_joint_constraints<6>(i, j, {.a = 1, .b = 1, .Sigma = 0});
  const std::string clue = "This is a joint's normal state. Do not divide by the distance.";
  for (int k = 0; k < 3; ++k) {
    const Constraint<6>& row = rows[static_cast<std::size_t>(k)];
    const std::string of = " along " + axis_names[static_cast<std::size_t>(k)] + ", with the points together";
    const Vec3 e = Vec3::Unit(k);
    expect_near("gap" + of + " [m]", "Eq. (6.5)", row.gap, 0, {0, "exact"}, {}, clue);
    expect_true("the row" + of + " has no bounds", "Eq. (6.4)", row.lo == -infinity && row.hi == infinity,
                "A joint whose gap is 0 has its three rows, too: they hold the velocities.");
    expect_near_vector("Gj" + of, "Eq. (6.6)", row.Gj, twist(e, j.r.cross(e)), roundings(8), {}, clue);
    expect_near_vector("Gi" + of, "Eq. (6.6)", row.Gi, twist(-e, -i.r.cross(e)), roundings(8), {}, clue);
  }
}

// With the first point at the origin the gaps are the second point itself, with all digits.
EXERCISE_TEST(BallJointConstraints, DropsNoSmallGap) {
  for (const double off : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
    const Vec3 apart = off * Vec3(1, -2, 3);
    const auto rows = ball_joint_constraints<3>({.body = 0, .x = Vec3::Zero()}, {.body = 1, .x = apart},
                                                {.a = 1, .b = 1, .Sigma = 0});
    expect_near_vector(
        "gaps of points that are " + show(apart.norm()) + " m apart [m]", "Eq. (6.5)",
        Vec3(rows[0].gap, rows[1].gap, rows[2].gap), apart, roundings(8, apart.norm()),
        {{Vec3::Zero(),
          "This small gap has been dropped. It needs no case of its own, since nothing is divided by it."}},
        "g = p_j - p_i, however small.");
    if (::testing::Test::HasFailure()) return;
  }
}

// The rows compared with the returned gaps.
EXERCISE_TEST(BallJointConstraints, TimesVelocityIsTheRateOfTheGaps) {
  RandomPair t;
  const auto rows = rows_between(t);
  const double dt = 1e-5;
  const auto gaps_after = [&](double time, const Twist<6>& Wi, const Twist<6>& Wj) -> Vec3 {
    const auto then =
        ball_joint_constraints<6>(attachment_after(time, t.i, Wi), attachment_after(time, t.j, Wj), t.spook);
    return {then[0].gap, then[1].gap, then[2].gap};
  };
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    const Twist<6> Wi = t.random.twist();
    const Twist<6> Wj = t.random.twist();
    const Vec3 rate = (gaps_after(dt, Wi, Wj) - gaps_after(-dt, Wi, Wj)) / (2 * dt);
    Vec3 got;
    for (int k = 0; k < 3; ++k) {
      const Constraint<6>& row = rows[static_cast<std::size_t>(k)];
      got[k] = row.Gi.dot(Wi) + row.Gj.dot(Wj);
    }
    expect_near_vector(
        "G W of the rows along x, y, z, against the gaps of two moving, turning bodies, differentiated "
        "numerically [m/s]",
        "Eq. (6.5), (6.6)", got, rate,
        {1e-8, "dt²/6 |ω|³|r| of two bodies < 3e-10, and 16 roundings of 6 m over dt"},
        {{-rate, "These are the rates of p_i - p_j: i and j are exchanged, or the sign of G."}},
        "The gaps change as the velocity of j's point, v + ω × r, minus that of i's.");
  }
}

EXERCISE_TEST(BallJointConstraints, TakesNoMomentum) {
  const RandomPair t;
  const auto rows = rows_between(t);
  for (int k = 0; k < 3; ++k) {
    const Constraint<6>& row = rows[static_cast<std::size_t>(k)];
    const std::string along = " along " + axis_names[static_cast<std::size_t>(k)];
    expect_near_vector("sum of the linear blocks of the row" + along, "Eq. (6.6)",
                       Vec3(row.Gi.head<3>() + row.Gj.head<3>()), Vec3::Zero(), roundings(4), {},
                       "Action equals reaction: e on j, -e on i.");
    expect_near_vector(
        "angular momentum about the origin that an impulse of 1 N s" + along + " adds [kg m²/s]",
        "Eq. (6.5), (6.6)", angular_momentum_of(row, t.i, t.j), t.apart().cross(Vec3::Unit(k)),
        roundings(64, t.size()), {},
        "Opposite pulls at two points that are p_j - p_i apart have the torque (p_j - p_i) × e, and no more.");
  }
}

// Two free bodies and a joint that makes the two velocities equal: a = 0, b = 1, Σ = 0.
EXERCISE_TEST(BallJointConstraints, LetsThePointsMoveAsOne) {
  RandomPair t;
  t.i.body = 0, t.j.body = 1;
  t.spook = {.a = 0, .b = 1, .Sigma = 0};
  const auto rows = rows_between(t);
  Motion<6> motion;
  for (int k = 0; k < 2; ++k) {
    const Rigid body = random_box(t.random);
    motion.inverse_mass.push_back(
        {.linear = body.inverse_mass, .angular = world_inertia(body.q, body.principal.cwiseInverse())});
    motion.W.push_back(t.random.twist());
    motion.Wf.push_back(Twist<6>::Zero());
  }
  const auto point_velocity = [](const Attachment& at, const Twist<6>& W) -> Vec3 {
    return W.head<3>() + W.tail<3>().cross(at.r);
  };
  const Vec3 u = point_velocity(t.j, motion.W[1]) - point_velocity(t.i, motion.W[0]);
  const Mat3 K = collision_matrix(motion.inverse_mass[0], t.i.r, motion.inverse_mass[1], t.j.r);
  const Solution<6> s =
      solved<6>({rows[0], rows[1], rows[2]}, motion, {.max_sweeps = 100000, .tolerance = 1e-13});
  const Vec3 after = point_velocity(t.j, motion.W[1] + s.V[1]) - point_velocity(t.i, motion.W[0] + s.V[0]);
  const double condition = K.norm() * K.inverse().norm();
  const Tolerance tolerance{1e-12 * condition,
                            "10 times what a sweep may still change, times the condition of K"};
  expect_near_vector(
      "relative velocity of the two points after the solve [m/s]", "Eq. (6.6)", after, Vec3::Zero(), tolerance,
      {{u, "Nothing has changed."}},
      "Three rows hold all three coefficients. A row along the line of the points holds only one.");
  expect_near_vector("impulse on body j, λ of the rows along x, y, z [N s]", "Eq. (3.8), (6.6)",
                     Vec3(s.lambda[0], s.lambda[1], s.lambda[2]), -K.inverse() * u,
                     {tolerance.value * K.inverse().norm(), tolerance.reason}, {},
                     "To change the relative velocity by -u takes the impulse -K⁻¹ u.");
}

EXERCISE_TEST(BallJointConstraints, DropsNothingSmall) {
  for (const double part : relative_scales) {
    const Attachment i{.body = 0, .x = Vec3::Zero(), .r = Vec3(1, 0, 0)},
        j{.body = 1, .x = Vec3(1, part, 1), .r = Vec3(0, 0, -1)};
    const auto rows = ball_joint_constraints<6>(i, j, {.a = 1, .b = 1, .Sigma = 0});
    expect_near("gap along y of two points that are " + show(part) + " m apart, at arms of 1 m [m]",
                "Eq. (6.5)", rows[1].gap, part, roundings(2, part),
                {{0, "It counts as closed. " + small_is_dropped}}, small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
  for (const double part : relative_scales)  // one of the bodies is nearly at the origin
    for (const bool i_is_near : {true, false}) {
      const Attachment near{.body = 0, .x = part * Vec3(1, 2, 3)}, far{.body = 1, .x = Vec3(3, 1, 2)};
      const auto rows = i_is_near ? ball_joint_constraints<6>(near, far, {.a = 1, .b = 1, .Sigma = 0})
                                  : ball_joint_constraints<6>(far, near, {.a = 1, .b = 1, .Sigma = 0});
      const Vec3 expected = (i_is_near ? 1 : -1) * (far.x - near.x);
      expect_near_vector("gaps where a body is " + show(near.x.norm()) + " m from the origin [m]", "Eq. (6.5)",
                         Vec3(rows[0].gap, rows[1].gap, rows[2].gap), expected, roundings(4), {},
                         small_is_dropped);
      if (::testing::Test::HasFailure()) return;
    }
  for (const double part : relative_scales)
    for (const Vec3& apart : lopsided(part)) {
      const auto rows = ball_joint_constraints<6>({.body = 0, .x = Vec3::Zero()}, {.body = 1, .x = apart},
                                                  {.a = 1, .b = 1, .Sigma = 0});
      expect_each_near<Vec3>("gaps of two points that are 1 m apart, nearly along an axis [m]", "Eq. (6.5)",
                             Vec3(rows[0].gap, rows[1].gap, rows[2].gap), apart, 2);
      if (::testing::Test::HasFailure()) return;
    }
}

}  // namespace
