// The common update of two friction rows: by hand, compared with bisection, and for any tangents.
#include "exercise_test.hpp"
#include "friction_systems.hpp"
#include "regions.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(UpdateFriction, "9.5 update_friction");

// A floor and a body whose tangential S is ((4, 1), (1, 2))/kg: Γ = 1/kg and G M⁻¹ Gᵀ = ((3, 1), (1, 1))/kg. Eq. (9.5)
// gives s = 3 + √2. B is the residual of the two rows at λ = 0.
System<3> by_hand(const Vec2& B, double press, double mu) {
  System<3> s;
  add_body<3>(s, {});
  add_body<3>(s, {.linear = 1});
  const auto row = [](const Vec3& G, const Vec3& MinvG, double right, double Gamma, double diagonal) {
    return Row<3>{.i = 0,
                  .j = 1,
                  .Gi = -G,
                  .Gj = G,
                  .MinvGi = Vec3::Zero(),
                  .MinvGj = MinvG,
                  .B = right,
                  .Sigma = Gamma,
                  .diagonal = diagonal,
                  .lo = -0.01,
                  .hi = 0.01};
  };
  s.rows = {row(Vec3::UnitZ(), Vec3::UnitZ(), 0, 0, 1), row(Vec3::UnitX(), Vec3(3, 1, 0), B.x(), 1, 4),
            row(Vec3::UnitY(), Vec3(1, 1, 0), B.y(), 1, 2)};
  s.rows[0].lo = 0;
  s.rows[0].hi = infinity;
  s.contacts = {{.normal = 0, .mu = mu}};
  s.begin_with(0, press);
  return s;
}

EXERCISE_TEST(UpdateFriction, DividesByTheStiffestDirection) {
  const double root = std::numbers::sqrt2, s_right = 3 + root;
  const Vec2 B(7, -3);
  System<3> s = by_hand(B, 1, 100);
  const double got = update_friction(s.contacts[0], s.rows, s.V);
  expect_near_vector(
      "λ_t [N s] from 0, of rows that lack (7, -3) m/s, S = ((4, 1), (1, 2))/kg, far inside the cone",
      "Eq. (9.5), (9.6)", s.tangential(s.contacts[0]), Vec2(B / s_right), roundings(16, 3),
      {{Vec2(7.0 / 4, -3.0 / 2),
        "Each row has been divided by its own diagonal. Divide both by s, or the update changes the direction "
        "of the residual."},
       {Vec2(7.0 / 4, -3.0 / 2 - 7.0 / 8),
        "These are two updates of Eq. (4.7), one after the other. The two rows go together."},
       {Vec2(7 / s_right, (-3 - 7 / s_right) / s_right),
        "The second row used the update of the first. Compute both residuals first, and then change both."},
       {Vec2(B / (3 - root)), "The sign of the root: this is the softest direction, and the step overshoots."},
       {Vec2(B / 3), "This is the mean of S11 and S22. Along the stiffest direction that is too long a step."},
       {Vec2(B / 4),
        "This is the larger of S11 and S22. With S12 the stiffest direction is stiffer than either."},
       {Vec2(B / 6), "This is S11 + S22: always safe, but the step is shorter than it may be."},
       {Vec2(B / (3 + std::sqrt(5.0))), "Under the root: half the difference of S11 and S22, squared."},
       {Vec2(B / (2 + root)), "Γ is missing in the diagonals: row.diagonal has it."},
       {Vec2(B / 5), "This is S11 + S12, or a sum like it. Eq. (9.5) has a root."},
       {Vec2(-B / s_right), "The sign: a positive residual needs a positive change."},
       {Vec2(0.01, -0.01), "This uses the rows' bounds `lo` and `hi`. Here the cone replaces them."},
       {Vec2(0, 0), "No λ has been stored."}},
      "λ_t + r_t/s, with s = (S11 + S22)/2 + √(((S11 - S22)/2)² + S12²) = 3 + √2.");
  expect_near("what it returns [m/s]", "Eq. (9.6)", got, B.norm(), roundings(32, 8),
              {{B.norm() / s_right, "This is |Δλ_t|, an impulse. Times s it is a velocity."},
               {7, "This is the larger of the two. It is the length of Δλ_t that counts."},
               {10, "This adds up the two. It is the length of Δλ_t that counts."}},
              "s |Δλ_t|.");
}

// In the tests by hand the floor does not move, and i has no part in S12. Here both bodies do.
EXERCISE_TEST(UpdateFriction, CountsBothBodies) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    System<6> s = random_bodies(random, 2);
    add_random_contact(s, random, 1);
    s.begin_with(0, 100);  // far inside the cone
    const Vec2 lacks = s.slip_lacks(s.contacts[0]);
    const Row<6>&a = s.rows[1], &b = s.rows[2];
    const Eigen::Matrix2d S = tangential_S(s, s.contacts[0]);
    const auto with = [&](double S12) {
      return Vec2(lacks / larger_eigenvalue((Eigen::Matrix2d() << S(0, 0), S12, S12, S(1, 1)).finished()));
    };
    update_friction(s.contacts[0], s.rows, s.V);
    expect_near_vector(
        "λ_t [N s] from 0 of a contact of two bodies that both move, far inside the cone", "Eq. (9.5), (9.6)",
        s.tangential(s.contacts[0]), with(S(0, 1)), roundings(64, 5),
        {{with(a.Gj.dot(b.MinvGj)), "S12 has a part of each body: that of i is missing."},
         {with(a.Gi.dot(b.MinvGi)), "S12 has a part of each body: that of j is missing."},
         {with(a.Gi.dot(b.Gi) + a.Gj.dot(b.Gj)), "S12 has M⁻¹ between the two rows: `MinvGi` and `MinvGj`."},
         {with(a.Gi.dot(b.MinvGi) - a.Gj.dot(b.MinvGj)),
          "The parts of i and j in S12 have been subtracted: add them."},
         {with(0), "S12 is missing."}},
        "λ_t + r_t/s, with S12 = G_1,i M⁻¹ G_2,i + G_1,j M⁻¹ G_2,j.");
  }
}

EXERCISE_TEST(UpdateFriction, KeepsTheConeOfTheNormalImpulseOfNow) {
  System<3> s = by_hand(Vec2(30, -40), 2, 0.25);
  const double got = update_friction(s.contacts[0], s.rows, s.V);
  const double stiffest = 3 + std::numbers::sqrt2;
  expect_near_vector(
      "λ_t [N s] of rows that lack (30, -40) m/s, μ = 0.25, λ_n = 2 N s", "Eq. (9.3), (9.6)",
      s.tangential(s.contacts[0]), Vec2(0.3, -0.4), roundings(16),
      {{Vec2(30, -40) / stiffest, "λ_t is outside the cone: |λ_t| <= μ λ_n."},
       {Vec2(0.5, -0.5), "This is a box of ±μ λ_n. The disc shortens both components alike."},
       {Vec2(1.2, -1.6), "μ is missing: the radius is μ λ_n."},
       {Vec2(0.01, -0.01), "This uses the rows' bounds `lo` and `hi`. Here μ λ_n replaces them."},
       {Vec2(0.006, -0.008), "The radius is μ λ_n, not a row's `hi`."},
       {Vec2(0.15, -0.2),
        "The radius is μ λ_n, with the μ of `contact`: not its square, and not half of it."}});
  expect_near("what it returns: s |Δλ_t| with |Δλ_t| = 0.5 N s [m/s]", "Eq. (9.6)", got, 0.5 * stiffest,
              roundings(32, 3),
              {{50, "This is the residual before the projection. Return the change after it."}});
}

EXERCISE_TEST(UpdateFriction, LetsGoWhereNothingPresses) {
  // Friction of before, in λ and in V, and a contact that has come apart since; or one on ice.
  for (const auto& [press, mu] : {std::pair(0.0, 0.5), std::pair(2.0, 0.0)}) {
    System<3> s = by_hand(Vec2(3, 1), press, mu);
    s.begin_with(1, 0.6);
    s.begin_with(2, -0.8);
    const double got = update_friction(s.contacts[0], s.rows, s.V);
    const std::string with = ", μ = " + show(mu) + ", λ_n = " + show(press) + " N s";
    expect_near_vector(
        "λ_t [N s] that was (0.6, -0.8)" + with, "Eq. (9.3), (9.6)", s.tangential(s.contacts[0]), Vec2::Zero(),
        {0, "exact"},
        {{Vec2(0.6, -0.8), "It keeps the old friction. A disc of radius 0 is a point, so λ_t becomes 0."}},
        "With λ_n = 0 or μ = 0 the radius μ λ_n is 0, so there is no friction.");
    expect_near("what it returns: s times 1 N s" + with + " [m/s]", "Eq. (9.6)", got, 3 + std::numbers::sqrt2,
                roundings(32, 5));
    expect_near_vector("V after it" + with, "Eq. (4.5)", all_V(s.V), V_of_lambda(s.rows, 2), roundings(64, 5),
                       {}, "Remove the old λ_t from V, too: scatter the change.");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(UpdateFriction, ProjectsTheImpulseNotItsChange) {
  System<3> s = by_hand(Vec2(-40, 0), 4, 0.25);  // radius 1
  s.begin_with(1, 0.8);
  s.begin_with(2, 0.6);
  const Vec2 lacks =
      s.slip_lacks(s.contacts[0]);  // (-40 - 3.8, -0.8 - 1.2): far outside, whatever it began with
  const double stiffest = 3 + std::numbers::sqrt2;
  const Vec2 wanted = Vec2(0.8, 0.6) + lacks / stiffest;
  update_friction(s.contacts[0], s.rows, s.V);
  expect_near_vector("λ_t [N s] from (0.8, 0.6), when the slip turns round, radius 1", "Eq. (9.6)",
                     s.tangential(s.contacts[0]), Vec2(wanted.normalized()), roundings(32),
                     {{Vec2(0.8, 0.6) + lacks.normalized(),
                       "The change has been projected instead of λ_t: the change may be twice the radius."},
                      {Vec2(lacks.normalized()), "The old λ_t is missing: project λ_t + r_t/s."}});
  expect_near_vector("V after it", "Eq. (4.5)", all_V(s.V), V_of_lambda(s.rows, 2), roundings(64, 5), {},
                     "V is M⁻¹ Gᵀ λ at all times: scatter the change of λ_t, after the projection.");
}

/// Two random bodies and one contact that presses with a random impulse.
System<6> random_touch(Random& random) {
  System<6> s = random_bodies(random, 2);
  add_random_contact(s, random, random.uniform(0.1, 1));
  s.begin_with(0, random.uniform(0.1, 2));
  return s;
}

EXERCISE_TEST(UpdateFriction, ScattersWhatItChanges) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    System<6> s = random_touch(random);
    const double normal = s.rows[0].lambda;
    for (int n = 0; n < 3; ++n) update_friction(s.contacts[0], s.rows, s.V);
    expect_near_vector("V after three updates", "Eq. (4.5)", all_V(s.V), V_of_lambda(s.rows, 2),
                       roundings(200, 10), {},
                       "Both rows scatter their change of λ to both bodies: V is M⁻¹ Gᵀ λ at all times.");
    expect_near("λ of the normal row [N s]", "Eq. (9.6)", s.rows[0].lambda, normal, {0, "untouched"}, {},
                "It is read, not changed.");
    for (const std::size_t k : {1u, 2u})
      expect_true("bounds of row " + std::to_string(k) + " are still those of before", "Eq. (9.6)",
                  s.rows[k].lo == -infinity && s.rows[k].hi == infinity,
                  "Neither use nor set the rows' own bounds.");
  }
}

// With S = s 1 the two rows are not coupled: a point mass, or a ball on a plane.
EXERCISE_TEST(UpdateFriction, SolvesAContactThatIsAlikeInAllDirectionsAtOnce) {
  Random random;
  Regions regions({"sticks", "slides", "nothing presses", "begins outside the disc", "Γ = 0"}, 20);
  while (regions.lack_draws()) {
    System<3> s;
    for (int body = 0; body < 2; ++body) {
      const double inverse_mass = random.uniform(0.2, 2);
      add_body<3>(s, {.linear = inverse_mass}, random.vector());
    }
    const Vec3 n = random.unit_vector(), zero = Vec3::Zero();
    const double Gamma = std::max(0.0, random.uniform(-0.2, 1)), press = std::max(0.0, random.uniform(-0.2, 2));
    const Tangents t = turned(n, random.uniform(0, 6));
    add_contact(s, {.i = 0, .j = 1, .n = n, .gap = 0, .r_i = zero, .r_j = zero}, t, random.uniform(0.1, 1), 0,
                Gamma);
    s.begin_with(0, press);
    const Vec2 sticks = Vec2(s.rows[1].B, s.rows[2].B) / s.rows[1].diagonal;
    const double radius = s.contacts[0].mu * press;
    if (random.integer(0, 1)) {
      s.begin_with(1, random.uniform(-2, 2));
      s.begin_with(2, random.uniform(-2, 2));
    }
    regions.draw({{"sticks", sticks.norm() < radius},
                  {"slides", press > 0 && sticks.norm() > radius},
                  {"nothing presses", press == 0},
                  {"begins outside the disc", s.tangential(s.contacts[0]).norm() > radius},
                  {"Γ = 0", Gamma == 0}});
    const Vec2 expected = sticks.norm() <= radius ? sticks : Vec2(radius * sticks.normalized());
    update_friction(s.contacts[0], s.rows, s.V);
    expect_near_vector("λ_t [N s] after one update; it would stick with |λ_t| = " + show(sticks.norm()) +
                           ", and may have " + show(radius),
                       "Eq. (9.6)", s.tangential(s.contacts[0]), expected, roundings(64, 5),
                       {{Vec2(std::clamp(sticks.x(), -radius, radius), std::clamp(sticks.y(), -radius, radius)),
                         "This is a box of ±μ λ_n."}},
                       "If S is the same in all directions, one update is exact: stick, or λ_t on the edge "
                       "against the slip.");
  }
}

/// The minimum of ½ λ·Sλ - B·λ on a disc: inside it, or where (S + ν) λ = B has the length of the radius. ν by
/// bisection.
Vec2 solve_on_disc(const Eigen::Matrix2d& S, const Vec2& B, double radius) {
  const auto at = [&](double nu) { return Vec2((S + nu * Eigen::Matrix2d::Identity()).inverse() * B); };
  if (at(0).norm() <= radius) return at(0);
  double low = 0, high = B.norm() / radius;
  for (int n = 0; n < 200; ++n) {
    const double middle = (low + high) / 2;
    (at(middle).norm() > radius ? low : high) = middle;
  }
  return at(high);
}

// Each update shortens the error by 1 - s_min/s at least. The random bodies have s_min/s above 0.01.
EXERCISE_TEST(UpdateFriction, ConvergesToCoulombsLaw) {
  Random random;
  Regions regions({"sticks", "slides"}, 10);
  while (regions.lack_draws()) {
    System<6> s = random_touch(random);
    const FrictionContact contact = s.contacts[0];
    const Eigen::Matrix2d S = tangential_S(s, contact);
    const Vec2 B = s.slip_lacks(contact);
    const double radius = contact.mu * s.rows[0].lambda;
    const bool sticks = Vec2(S.inverse() * B).norm() < radius;
    regions.draw({{"sticks", sticks}, {"slides", !sticks}});
    for (int n = 0; n < 4000; ++n) update_friction(contact, s.rows, s.V);
    expect_near_vector(
        "λ_t [N s] after 4000 updates of one contact, radius " + show(radius), "Eq. (9.6)",
        s.tangential(contact), solve_on_disc(S, B, radius), {1e-10, "roundings over a step of s_min/s > 0.01"},
        {},
        "Against bisection on (S + ν) λ = B, |λ| = μ λ_n: inside the disc it sticks, on its edge λ_t "
        "is against the slip that is left.");
  }
}

EXERCISE_TEST(UpdateFriction, LowersTheEnergyWhileThePressureStays) {
  Random random;
  for (int trial = 0; trial < 100 && !::testing::Test::HasFailure(); ++trial) {
    System<6> s = random_touch(random);
    const FrictionContact contact = s.contacts[0];
    const Eigen::Matrix2d S = tangential_S(s, contact);
    const Vec2 B = s.slip_lacks(contact);
    const auto energy = [&] {
      const Vec2 lambda = s.tangential(contact);
      return lambda.dot(S * lambda) / 2 - B.dot(lambda);
    };
    double before = 0;
    for (int n = 0; n < 20; ++n) {
      update_friction(contact, s.rows, s.V);
      const double now = energy();
      expect_at_most("energy after update " + std::to_string(n + 1) + ", ½ λ·Sλ - B·λ [J]", "Eq. (9.5), (9.6)",
                     now, before + roundings(64, 10).value, "that of before: a step of 1/s is never too long",
                     "Friction that adds energy has the wrong sign, or its step is too long: divide by s.");
      before = now;
    }
  }
}

EXERCISE_TEST(UpdateFriction, IsIndependentOfTheTangents) {
  Random random;
  for (int trial = 0; trial < 50 && !::testing::Test::HasFailure(); ++trial) {
    System<6> bodies = random_bodies(random, 2);
    const Contact contact = random_contact(random, 2);
    const double angle = random.uniform(0, 6), by = random.uniform(0, 6), press = random.uniform(0.1, 1);
    const double mu = random.uniform(0.1, 1);
    std::vector<Vec3> impulses;
    for (const double turn : {angle, angle + by}) {
      System<6> s = bodies;
      const Tangents t = turned(contact.n, turn);
      add_contact(s, contact, t, mu, 0.1, 0.1);
      s.begin_with(0, press);
      for (int n = 0; n < 3; ++n) update_friction(s.contacts[0], s.rows, s.V);
      impulses.push_back(s.rows[1].lambda * t.t1 + s.rows[2].lambda * t.t2);
    }
    expect_near_vector(
        "friction after three updates [N s], tangents turned by " + show(by) + " rad", "Eq. (9.5), (9.6)",
        impulses[1], impulses[0], roundings(1000, 5), {},
        "The disc, s and r_t/s have no corners: the impulse in space is the same for any t1 and t2.");
  }
}

EXERCISE_TEST(UpdateFriction, FindsItsRows) {
  Random random;
  System<6> s = random_system(random, 3, 2, 0.5);
  for (const FrictionContact& contact : s.contacts) s.begin_with(contact.normal, 1);
  const auto before = all_lambda(s.rows);
  const FrictionContact& second = s.contacts[1];
  update_friction(second, s.rows, s.V);
  for (std::size_t k = 0; k < s.rows.size(); ++k) {
    const bool its = k == second.normal + 1 || k == second.normal + 2;
    const double old = before[static_cast<Eigen::Index>(k)];
    expect_true("row " + std::to_string(k) + (its ? " has changed" : " is as it was") +
                    ", after an update of the contact whose normal is row " + std::to_string(second.normal),
                "Eq. (9.6)", its == (s.rows[k].lambda != old),
                "Its rows are contact.normal + 1 and contact.normal + 2.");
  }
}

EXERCISE_TEST(UpdateFriction, KeepsANaN) {
  const std::string clue =
      "A NaN went in and no NaN came out: onto_disc() keeps it, std::min and std::max do not.";
  for (const std::size_t broken : {0u, 1u, 2u}) {
    System<3> s = by_hand(Vec2(1, 1), 1, 0.5);
    if (broken == 0)
      s.rows[0].lambda = std::nan("");
    else
      s.rows[broken].B = std::nan("");
    const double got = update_friction(s.contacts[0], s.rows, s.V);
    const std::string what = broken == 0 ? "a normal impulse of NaN" : "a right side of NaN";
    expect_true(what + " makes a λ_t of NaN", "Eq. (9.6)", s.tangential(s.contacts[0]).hasNaN(), clue);
    expect_true(what + " makes it return NaN", "Eq. (9.6)", std::isnan(got), clue);
  }
}

}  // namespace
