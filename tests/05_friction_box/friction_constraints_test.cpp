// The two friction constraints of a contact: their fields, and their rows for two bodies.
#include "exercise_test.hpp"
#include "sliding.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(FrictionConstraints, "5.5 friction_constraints");

const SpookParameters rigid{.a = 0, .b = 1, .Sigma = 0};

struct AnyContact {
  Random random;
  Tangents t = random_tangents(random);
  Contact contact{
      .i = 3, .j = 1, .n = normal_of(t), .gap = -0.02, .r_i = random.vector(), .r_j = random.vector()};
};

EXERCISE_TEST(FrictionConstraints, PointAlongTheTangents) {
  const AnyContact touch;
  const Contact& contact = touch.contact;
  const Vec3 &r_i = contact.r_i, &r_j = contact.r_j, &n = contact.n;
  for (std::size_t row = 0; row < 4 && !::testing::Test::HasFailure(); ++row) {
    const std::size_t k = row % 2;
    const bool left_handed = row >= 2;
    const Tangents both{touch.t.t1, left_handed ? Vec3(-touch.t.t2) : touch.t.t2};
    const auto constraints = friction_constraints<6>(contact, both, 0.5, rigid);
    const Vec3 &t = k == 0 ? both.t1 : both.t2, &other = k == 0 ? both.t2 : both.t1;
    const Vec3 own = k == 0 ? other : n.cross(both.t1);
    const std::string name = std::to_string(k + 1) + (left_handed ? ", for t1 × t2 = -n" : "");
    const std::string made = "This is along n × t1. Use t2 as it is given.";
    const std::string normal = "This is the row of the contact itself, along n. Friction acts along a tangent.";
    const std::string same =
        k == 0 ? "This is along t2: t1 comes first." : "This is along t1 again: the second is along t2.";
    const std::string flat = "The angular block is missing: friction beside the centre also turns the body.";
    const std::string arms = "This has the other body's lever arm.";
    expect_near_vector("Gj of friction constraint " + name, "Eq. (3.3), (5.2)", constraints[k].Gj,
                       twist(t, r_j.cross(t)), roundings(8, 2),
                       {{twist(n, r_j.cross(n)), normal},
                        {twist(other, r_j.cross(other)), same},
                        {twist(own, r_j.cross(own)), made},
                        {twist(t, Vec3::Zero()), flat},
                        {twist(t, r_i.cross(t)), arms},
                        {twist(t, t.cross(r_j)), "This is t × r_j. The torque of a push t at r is r × t."},
                        {twist(t, r_j.cross(n)), "The linear block is along t, the angular one still along n."},
                        {twist(-t, -r_j.cross(t)), "The sign: u is the velocity of j relative to i."}},
                       "Gj = (t, r_j × t): Eq. (3.3) with t in place of n.");
    expect_near_vector(
        "Gi of friction constraint " + name, "Eq. (3.3), (5.2)", constraints[k].Gi, twist(-t, -r_i.cross(t)),
        roundings(8, 2),
        {{twist(-n, -r_i.cross(n)), normal},
         {twist(-other, -r_i.cross(other)), same},
         {twist(-own, -r_i.cross(own)), made},
         {twist(-t, Vec3::Zero()), flat},
         {twist(-t, -r_j.cross(t)), arms},
         {twist(t, r_i.cross(t)),
          "The sign of body i: friction that brakes j must push i the other way. Gi = -(t, r_i × t)."},
         {twist(-t, r_i.cross(t)), "The sign of the angular block: both parts of Gi have a minus."},
         {Twist<6>::Zero(), "Body i has been left out: friction acts on both."}},
        "Gi = -(t, r_i × t): Eq. (3.3) with t in place of n.");
  }
}

EXERCISE_TEST(FrictionConstraints, TakePointMasses) {
  const AnyContact touch;
  const auto constraints = friction_constraints<3>(touch.contact, touch.t, 0.5, rigid);
  for (std::size_t k = 0; k < 2; ++k) {
    const Vec3& t = k == 0 ? touch.t.t1 : touch.t.t2;
    const std::string text = " of friction constraint " + std::to_string(k + 1) + " between point masses";
    expect_near_vector("Gj" + text, "Eq. (3.3), (5.2)", constraints[k].Gj, t, roundings(4), {},
                       "The linear block.");
    expect_near_vector("Gi" + text, "Eq. (3.3), (5.2)", constraints[k].Gi, Twist<3>(-t), roundings(4), {},
                       "The linear block.");
  }
}

EXERCISE_TEST(FrictionConstraints, CarryTheRestOver) {
  const AnyContact touch;
  const SpookParameters spook{
      .a = 3, .b = 0.75, .Sigma = 0.125};  // not friction's own values, but they must be copied
  for (const auto& constraint : friction_constraints<6>(touch.contact, touch.t, 0.75, spook)) {
    expect_true("the constraint has the contact's bodies", "Eq. (5.2)", constraint.i == 3 && constraint.j == 1,
                "Copy i and j, in that order.");
    const std::string copy = "Copy `spook`: it holds friction's own a, b and Γ.";
    const std::string again = " has been set here again. friction_parameters has set it: copy its result.";
    expect_near("a of a spook with a = 3 /s [1/s]", "Eq. (5.3)", constraint.spook.a, 3, {0, "a copy"},
                {{0, "a = 0" + again}}, copy);
    expect_near("b of a spook with b = 0.75", "Eq. (5.3)", constraint.spook.b, 0.75, {0, "a copy"},
                {{1, "b = 1" + again}}, copy);
    expect_near("Γ of a spook with Σ = 0.125 /kg [1/kg]", "Eq. (5.3)", constraint.spook.Sigma, 0.125,
                {0, "a copy"}, {{0, "Γ = 0: this row is rigid, and nothing creeps."}}, copy);
  }
}

EXERCISE_TEST(FrictionConstraints, AreBoundedOnBothSides) {
  const AnyContact touch;
  const std::string half_bound = "Half of the bound: λ may be as large as Λ either way, from -Λ to Λ.";
  for (const auto& constraint : friction_constraints<6>(touch.contact, touch.t, 0.75, rigid)) {
    expect_near("lower bound of λ, Λ = 0.75 N s [N s]", "Eq. (5.8)", constraint.lo, -0.75, {0, "a sign"},
                {{0, "This is a contact's bound. Friction acts both ways along t: from -Λ to Λ."},
                 {0.75, "The lower bound equals the upper one, so λ would be constant. It is -Λ."},
                 {-0.375, half_bound}},
                "-Λ <= λ <= Λ.");
    expect_near("upper bound of λ, Λ = 0.75 N s [N s]", "Eq. (5.8)", constraint.hi, 0.75, {0, "a copy"},
                {{0.375, half_bound}},
                "-Λ <= λ <= Λ. With a contact's bound, infinity, nothing would ever slide.");
  }
}

EXERCISE_TEST(FrictionConstraints, AreBoundedOnIceToo) {
  const AnyContact touch;
  for (const double bound : {0.0, 1e-300, 1e300}) {
    const std::string of = " bound of λ, Λ = " + show(bound) + " N s [N s]";
    const std::string clue =
        "Any Λ is a bound. Λ = 0 does not mean that there is no bound: on ice λ is 0, and there is no "
        "friction.";
    for (const auto& constraint : friction_constraints<6>(touch.contact, touch.t, bound, rigid)) {
      expect_near("lower" + of, "Eq. (5.8)", constraint.lo, -bound, {0, "a sign"}, {}, clue);
      expect_near("upper" + of, "Eq. (5.8)", constraint.hi, bound, {0, "a copy"}, {}, clue);
    }
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(FrictionConstraints, AreIndependentOfTheGap) {
  AnyContact touch;
  for (const double gap : {-0.02, 0.0, 0.02}) {
    touch.contact.gap = gap;
    for (const auto& constraint : friction_constraints<6>(touch.contact, touch.t, 0.75, rigid)) {
      const std::string text = " bound of λ at a contact with a gap of " + show(gap) + " m, Λ = 0.75 N s [N s]";
      const std::string clue =
          "A contact that is still open may close within the step and have friction. The argument `bound` "
          "limits it.";
      expect_near("lower" + text, "Eq. (5.8)", constraint.lo, -0.75, {0, "a sign"}, {}, clue);
      expect_near("upper" + text, "Eq. (5.8)", constraint.hi, 0.75, {0, "a copy"}, {}, clue);
      expect_near("gap of a friction constraint where the contact's is " + show(gap) + " m", "Eq. (5.3)",
                  constraint.gap, 0, {0, "exact"}, {}, "Friction makes a velocity zero, not a position.");
    }
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(FrictionConstraints, HaveNoGap) {
  const AnyContact touch;
  for (const auto& constraint : friction_constraints<6>(touch.contact, touch.t, 0.75, rigid))
    expect_near("gap of a friction constraint [m]", "Eq. (5.3)", constraint.gap, 0, {0, "exact"},
                {{touch.contact.gap,
                  "This is the contact's gap, along n. The overlap of two bodies must not drive them along the "
                  "plane."}},
                "Friction makes a velocity zero, not a position.");
}

EXERCISE_TEST(FrictionConstraints, HaveZeroSlipAsTheirTarget) {
  AnyContact touch;
  touch.contact.i = 0;
  const auto constraints = friction_constraints<6>(touch.contact, touch.t, 0.5, rigid);
  Random& random = touch.random;
  Motion<6> motion;
  for (int body = 0; body < 2; ++body) {
    motion.inverse_mass.push_back({.linear = 1, .angular = Mat3::Identity()});
    motion.W.push_back(random.twist());
    motion.Wf.push_back(random.twist());
  }
  // Relative velocity of j's contact point: u from velocities, u_f from what forces add.
  const auto seen = [&](const std::vector<Twist<6>>& W) -> Vec3 {
    const Vec3 w_i = W[0].tail<3>(), w_j = W[1].tail<3>();
    return W[1].head<3>() + w_j.cross(touch.contact.r_j) - W[0].head<3>() - w_i.cross(touch.contact.r_i);
  };
  const Vec3 u = seen(motion.W), u_f = seen(motion.Wf);
  for (std::size_t k = 0; k < 2; ++k) {
    const Vec3& t = k == 0 ? touch.t.t1 : touch.t.t2;
    expect_near("right side of friction row " + std::to_string(k + 1) + ", by make_row [m/s]",
                "Eq. (5.2), (5.3)", make_row(constraints[k], motion).B, -(u + u_f).dot(t), roundings(64, 10),
                {{(u + u_f).dot(t), "The sign: this friction would accelerate a sliding body."},
                 {-(u + u_f).dot(touch.contact.n), "This makes the velocity along n zero."}},
                "B = -u·t - u_f·t, of both contact points.");
  }
}

// Returns a rigid body with different moments, in any orientation.
InverseMass<6> random_body(Random& random) {
  const Mat3 R = random.rotation().toRotationMatrix();
  const Vec3 inverse_moments{random.uniform(0.5, 5), random.uniform(0.5, 5), random.uniform(0.5, 5)};
  return {.linear = 1 / random.uniform(0.5, 3), .angular = R * inverse_moments.asDiagonal() * R.transpose()};
}

// With a = 0 and b = 1 no update increases ½ V·M V + V·M W, also before the sweeps have converged.
EXERCISE_TEST(FrictionConstraints, NeverAddEnergy) {
  Random random;
  for (int trial = 0; trial < 200 && !::testing::Test::HasFailure(); ++trial) {
    const int bodies = random.integer(2, 4), sweeps = random.integer(1, 10);
    std::vector<Constraint<6>> constraints;
    for (int k = random.integer(1, 6); k > 0; --k) {
      const Tangents t = random_tangents(random);
      const int i = random.integer(0, bodies - 1), j = (i + random.integer(1, bodies - 1)) % bodies;
      const Contact contact{
          .i = i, .j = j, .n = normal_of(t), .gap = 0, .r_i = random.vector(), .r_j = random.vector()};
      const SpookParameters spook{.a = 0, .b = 1, .Sigma = random.uniform(0, 0.2)};
      for (const auto& constraint : friction_constraints<6>(contact, t, random.log_uniform(0.01, 10), spook))
        constraints.push_back(constraint);
    }
    Motion<6> motion;
    for (int body = 0; body < bodies; ++body) {
      motion.inverse_mass.push_back(random_body(random));
      motion.W.push_back(random.twist(3));
      motion.Wf.push_back(Twist<6>::Zero());
    }
    std::vector<Row<6>> rows;
    for (const auto& constraint : constraints) rows.push_back(make_row(constraint, motion));
    std::vector<Twist<6>> V(motion.W.size(), Twist<6>::Zero());
    solve(rows, V, {.max_sweeps = sweeps, .tolerance = 0});

    double before = 0, after = 0;
    for (std::size_t body = 0; body < V.size(); ++body) {
      const InverseMass<6>& inverse = motion.inverse_mass[body];
      const Mat3 inertia = inverse.angular.inverse();
      const auto energy = [&](const Twist<6>& W) {
        return (W.head<3>().squaredNorm() / inverse.linear + W.tail<3>().dot(inertia * W.tail<3>())) / 2;
      };
      before += energy(motion.W[body]);
      after += energy(motion.W[body] + V[body]);
    }
    expect_at_most("kinetic energy of " + std::to_string(bodies) + " bodies that rub at " +
                       std::to_string(rows.size() / 2) + " contacts, after " + std::to_string(sweeps) +
                       " sweeps [J]",
                   "Eq. (5.3), (5.8)", after, before * (1 + 1e-12),
                   "the energy before, and 1e-12 of it in "
                   "roundings",
                   "Friction can only brake. Does it act on both bodies, against their velocity?");
  }
}

EXERCISE_TEST(FrictionConstraints, TakeNoMomentum) {
  Random random;
  const Tangents t = random_tangents(random);
  const Vec3 point = random.vector(), x_i = random.vector(), x_j = random.vector();
  const Contact contact{.i = 0, .j = 1, .n = normal_of(t), .gap = 0, .r_i = point - x_i, .r_j = point - x_j};
  for (const auto& constraint : friction_constraints<6>(contact, t, 0.5, rigid)) {
    const Twist<6>&Gi = constraint.Gi, &Gj = constraint.Gj;
    expect_near_vector("momentum that a friction impulse of 1 N s adds to both bodies [kg m/s]", "Eq. (5.2)",
                       Vec3(Gi.head<3>() + Gj.head<3>()), Vec3::Zero(), roundings(4), {},
                       "Action equals reaction: +t on j and -t on i.");
    const Vec3 turn = x_i.cross(Gi.head<3>()) + Gi.tail<3>() + x_j.cross(Gj.head<3>()) + Gj.tail<3>();
    expect_near_vector("angular momentum that it adds, when the contact points meet [kg m²/s]", "Eq. (5.2)",
                       turn, Vec3::Zero(), roundings(32, 4), {},
                       "Two opposite pushes at one point have no torque. Look at r × t of both bodies.");
  }
}

constexpr double gravity = 9.81, mass = 2;

// The whole contact of a point mass on a slope, a normal row and the friction rows solved together.
// Returns the speed down the slope after that many steps, beginning at rest, at the depth of Eq. (3.13).
double speed_on_slope(int steps, double h, double mu, double theta, const Tangents& t) {
  const double k = 1e5, g_n = gravity * std::cos(theta);
  Contact contact = contact_between(0, 1, t);
  contact.gap = -mass * g_n / k;
  const auto friction = friction_constraints<3>(contact, t, mu * mass * g_n * h, rigid);
  const Vec3 n = normal_of(t), zero = Vec3::Zero(),
             v_f = h * gravity * (std::sin(theta) * t.t1 - std::cos(theta) * n);
  const SpookParameters spook = spook_parameters(h, k, 3);
  Motion<3> motion{.inverse_mass = {{.linear = 0}, {.linear = 1 / mass}}, .W = {zero, zero}, .Wf = {zero, v_f}};
  for (int step = 0; step < steps; ++step) {
    const Constraint<3> normal{.i = 0, .j = 1, .Gi = -n, .Gj = n, .gap = contact.gap, .spook = spook};
    motion.W[1] += v_f + solved<3>({normal, friction[0], friction[1]}, motion)[1];
    contact.gap += h * motion.W[1].dot(n);
  }
  return motion.W[1].dot(t.t1);
}

EXERCISE_TEST(FrictionConstraints, HoldABlockOnASlopeUpToTanTheta) {
  const AnyContact touch;
  const double h = 1.0 / 60;
  for (const double theta : {0.1, 0.7, 1.2}) {
    const double tangent = std::tan(theta), unit = h * gravity;
    expect_near("speed after 1000 steps on a slope, θ = " + show(theta) + ", μ = tan θ (1 + 1e-9) [m/s]",
                "Eq. (5.9)", speed_on_slope(1000, h, tangent * (1 + 1e-9), theta, touch.t), 0,
                roundings(64, unit), {},
                "With μ >= tan θ it sticks. Does each row have its full bound, on both sides?");
    const double mu = tangent * (1 - 1e-9);
    expect_near("speed after 100 steps on a slope, θ = " + show(theta) + ", μ = tan θ (1 - 1e-9) [m/s]",
                "Eq. (5.9)", speed_on_slope(100, h, mu, theta, touch.t),
                100 * h * gravity * (std::sin(theta) - mu * std::cos(theta)), roundings(64 * 100, unit),
                {{0, "It sticks, but it should slide. Is λ bounded on both sides?"}},
                "With μ < tan θ it slides, by 1e-9 of g sin θ.");
  }
}

EXERCISE_TEST(FrictionConstraints, LetABlockStayForTenThousandSteps) {
  const AnyContact touch;
  const double h = 1.0 / 60, F = 5;
  Block block{.m = mass, .h = h, .constraints = {}};
  block.add(friction_constraints<3>(contact_between(0, 1, touch.t), touch.t, 0.5 * mass * gravity * h, rigid));
  for (int n = 0; n < 10000; ++n) block.step(F * touch.t.t1);
  expect_near("creep in 10,000 steps of a block pushed by 5 N, c = ∞ [m]", "Eq. (5.5)", block.x.dot(touch.t.t1),
              0, roundings(10000 * 16, h * h * F / mass), {},
              "It must not move: the push is below μ m g = 9.81 N, and 1/c is 0.");
}

// A solid sphere, I = 2/5 m R², sent off along t1 without spin, by leapfrog from half a step early. Friction
// brakes it by μ g and spins it up by 5 μ g/(2R); u, at the contact, falls by 7/2 μ g.
EXERCISE_TEST(FrictionConstraints, LetASlidingSphereRoll) {
  const AnyContact touch;
  const Tangents& t = touch.t;
  const double h = 0.01, mu = 0.2, R = 0.25;
  const int sliding = 40;  // steps: v0 is such that it rolls after exactly these
  const double v0 = 3.5 * mu * gravity * h * sliding;
  const Contact contact{
      .i = 0, .j = 1, .n = normal_of(t), .gap = 0, .r_i = Vec3::Zero(), .r_j = -R * normal_of(t)};
  const auto friction = friction_constraints<6>(contact, t, mu * mass * gravity * h, rigid);
  const Twist<6> still = Twist<6>::Zero();
  const Twist<6> start = twist((v0 + mu * gravity * h / 2) * t.t1, -2.5 * mu * gravity / R * h / 2 * t.t2);
  const Mat3 inverse_inertia = Mat3::Identity() / (0.4 * mass * R * R);
  Motion<6> motion{.inverse_mass = {{}, {.linear = 1 / mass, .angular = inverse_inertia}},
                   .W = {still, start},
                   .Wf = {still, still}};
  Vec3 x = Vec3::Zero();
  const auto step = [&] {
    motion.W[1] += solved<6>({friction[0], friction[1]}, motion)[1];
    x += h * motion.W[1].head<3>();
  };
  for (int n = 0; n < sliding; ++n) step();
  expect_near("distance of a sphere after 2 v0/(7 μ g) [m]", "Eq. (5.11)", x.dot(t.t1),
              12 * v0 * v0 / (49 * mu * gravity), roundings(64 * sliding, v0 * h * sliding),
              {{(v0 + mu * gravity * h / 2) * h * sliding, "Nothing has braked it."}},
              "12 v0²/(49 μ g): until then it slides, braked by μ g.");
  step();
  const Vec3 v = motion.W[1].head<3>(), omega = motion.W[1].tail<3>();
  expect_near_vector("velocity of the contact point once it rolls [m/s]", "Eq. (5.11)",
                     Vec3(v + omega.cross(contact.r_j)), Vec3::Zero(), roundings(64 * sliding, v0), {},
                     "Friction stops the contact point, v + ω × r, not the centre.");
  expect_near_vector("velocity of the sphere once it rolls [m/s]", "Eq. (5.11)", v, Vec3(5 * v0 / 7 * t.t1),
                     roundings(64 * sliding, v0),
                     {{(v0 - mu * gravity * h * (sliding + 0.5)) * t.t1,
                       "It slows down like a block. Friction must turn it, too: r × t."}},
                     "5/7 of v0, for any μ: the angular momentum about the contact is conserved.");
  for (int n = 0; n < 1000; ++n) step();
  expect_near_vector("velocity 1000 steps later [m/s]", "Eq. (5.11)", Vec3(motion.W[1].head<3>()),
                     Vec3(5 * v0 / 7 * t.t1), roundings(64 * sliding + 8000, v0), {},
                     "It goes on rolling, with no friction.");
}

// The friction box has corners, and they turn with the tangents.

double across(double phi) {
  return std::max(std::abs(std::cos(phi)), std::abs(std::sin(phi)));
}

EXERCISE_TEST(FrictionConstraints, AreStrongerAlongTheDiagonal) {
  const AnyContact touch;
  const double h = 1.0 / 60, mu = 0.5;
  Block block{.m = mass, .h = h, .constraints = {}};
  block.add(friction_constraints<3>(contact_between(0, 1, touch.t), touch.t, mu * mass * gravity * h, rigid));
  const double quarter = std::acos(0) / 2;
  Random random;
  std::vector<double> angles = {0, quarter, 2 * quarter, 3 * quarter, 5 * quarter};
  for (int k = 0; k < 10; ++k) angles.push_back(random.uniform(0, 8 * quarter));
  for (const double phi : angles) {
    const double F = mu * mass * gravity / across(phi);
    const std::string text = ", pushed at φ = " + show(phi) + " from t1 by μ m g/max(|cos φ|, |sin φ|) times ";
    Block below = block, above = block;
    for (int n = 0; n < 100; ++n) {
      below.step((1 - 1e-9) * F * heading(touch.t, phi));
      above.step((1 + 1e-9) * F * heading(touch.t, phi));
    }
    expect_near("speed after 100 steps" + text + "1 - 1e-9 [m/s]", "Eq. (5.8), (5.12)",
                std::hypot(below.v.dot(touch.t.t1), below.v.dot(touch.t.t2)), 0, roundings(64, h * F / mass),
                {}, "It should stick: each row has its own bound Λ, so that the sum at 45° is √2 Λ.");
    const double slip = std::max(std::abs(above.v.dot(touch.t.t1)), std::abs(above.v.dot(touch.t.t2)));
    expect_near("its larger component after 100 steps" + text + "1 + 1e-9 [m/s]", "Eq. (5.8), (5.12)", slip,
                1e-9 * 100 * h * mu * gravity, roundings(64 * 100, h * F / mass),
                {{0, "It should slide. Is λ bounded on both sides?"}},
                "The row with the larger component of the push reaches its bound first.");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(FrictionConstraints, StopEachComponentForItself) {
  const AnyContact touch;
  const Tangents& t = touch.t;
  const double h = 0.005, mu = 0.5, A = mu * gravity;
  Block block{.m = mass, .h = h, .constraints = {}};
  block.add(friction_constraints<3>(contact_between(0, 1, t), t, mu * mass * gravity * h, rigid));
  const Vec3 ahead = t.t1 + t.t2;
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    const double phi = random.uniform(0.2, 1.35), v0 = random.uniform(2, 4);
    const double c = std::cos(phi), s = std::sin(phi);
    Block sent = block;
    sent.v = v0 * heading(t, phi) + A * h / 2 * ahead;  // half a step early
    int steps = 0;
    for (; steps < 1000; ++steps) {
      sent.step();
      if (!(sent.v.norm() > 1e-9)) break;
    }
    given() = "sent off at " + show(v0) + " m/s, at φ = " + show(phi) + " from t1; μ = 0.5, h = 0.005 s";
    expect_at_most("time until it stops less v0 max(|cos φ|, |sin φ|)/(μ g) [s]", "Eq. (5.12)",
                   std::abs(steps * h - v0 * across(phi) / A), h * (0.5 + 1e-6), "half a step",
                   "The larger component decides the time, and the other one does not shorten it.");
    const Tolerance slides{1e-12 * v0 * v0 / A, "a few roundings of v in each of up to 200 steps, added up"};
    expect_near("distance along t1 [m]", "Eq. (5.13)", sent.x.dot(t.t1), stopping_distance(v0 * c, A, h),
                slides, {}, "Each component decreases by μ g until it is zero, independently of the other.");
    expect_near("distance along t2 [m]", "Eq. (5.13)", sent.x.dot(t.t2), stopping_distance(v0 * s, A, h),
                slides, {}, "Each component decreases by μ g until it is zero, independently of the other.");
    expect_near("distance from start to stop [m]", "Eq. (5.13)", sent.x.norm(),
                std::sqrt(c * c * c * c + s * s * s * s) * v0 * v0 / (2 * A),
                {A * h * h / 4, "μ g h²/8 along each tangent"},
                {{v0 * v0 / (2 * A),
                  "This is Coulomb's distance. The box stops it earlier, unless it goes along a tangent."}},
                "√(cos⁴φ + sin⁴φ) v0²/(2 μ g).");
  }
}

// A thin disc of uniform pressure: rings of equal area, each at its mean radius, so that Coulomb's torque is
// exactly 2/3 μ m g R. With 4q spokes, none along a tangent, the mean of |cos φ| + |sin φ| is
// 1/(q sin(π/(4q))), which tends to 4/π.
EXERCISE_TEST(FrictionConstraints, StopASpinningDiscEarly) {
  const AnyContact touch;
  const Tangents& t = touch.t;
  const Vec3 n = normal_of(t);
  const double h = 1.0 / 60, mu = 0.4, R = 0.5, pi = 2 * std::acos(0);
  const int rings = 3, q = 6, contacts = rings * 4 * q;
  std::vector<Constraint<6>> constraints;
  const double bound = mu * mass / contacts * gravity * h;
  for (int ring = 0; ring < rings; ++ring) {
    const double a = std::sqrt(ring / 3.0), b = std::sqrt((ring + 1) / 3.0);
    const double radius = 2.0 / 3 * R * (b * b * b - a * a * a) / (b * b - a * a);
    for (int spoke = 0; spoke < 4 * q; ++spoke) {
      const Vec3 r = radius * heading(t, (spoke + 0.5) * pi / (2 * q));
      const Contact contact{.i = 0, .j = 1, .n = n, .gap = 0, .r_i = r, .r_j = r};
      for (const auto& row : friction_constraints<6>(contact, t, bound, rigid)) constraints.push_back(row);
    }
  }
  const double coulomb = 4 * mu * gravity / (3 * R);  // [rad/s²]
  const double box = coulomb / (q * std::sin(pi / (4 * q)));
  const int steps = 10;
  const double omega0 = (steps + 0.3) * box * h;
  const Mat3 along = n * n.transpose();
  const Mat3 inverse_inertia = (2 * along + 4 * (Mat3::Identity() - along)) / (mass * R * R);
  const Twist<6> still = Twist<6>::Zero();
  Motion<6> motion{.inverse_mass = {{}, {.linear = 1 / mass, .angular = inverse_inertia}},
                   .W = {still, twist(Vec3::Zero(), omega0 * n)},
                   .Wf = {still, still}};
  const auto step = [&] { motion.W[1] += solved(constraints, motion)[1]; };
  for (int k = 0; k < steps; ++k) step();
  const double spin = motion.W[1].tail<3>().dot(n);
  expect_near("spin of a disc after 10 steps of 10.3 that the box needs [rad/s]", "Eq. (5.14)", spin,
              omega0 - steps * box * h,
              {1e-9 * omega0, "the solver's tolerance, 1e-14 m/s a row, and its condition"},
              {{omega0 - steps * coulomb * h,
                "This is Coulomb's disc. A friction box is stronger towards its "
                "corners."},
               {omega0, "Its spin does not change: r × t is missing."}},
              "Each spoke has |cos φ| + |sin φ| times Coulomb's friction, 4/π in the mean.");
  step();
  expect_near("spin one step later [rad/s]", "Eq. (5.14)", motion.W[1].tail<3>().dot(n), 0,
              {1e-9 * omega0, "the solver's tolerance, 1e-14 m/s a row, and its condition"}, {},
              "It stops after π/4 of Coulomb's 3 R ω0/(4 μ g), computed for 24 spokes.");
}

}  // namespace
