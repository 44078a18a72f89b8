// Sweeps on cones until the tolerance is met: Coulomb's law, and scenes with known answers.
#include "exercise_test.hpp"
#include "friction_systems.hpp"
#include "regions.hpp"
#include "stop_rule.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(ConeSolve, "9.8 cone_solve");

constexpr StopRule long_and_sharp{.max_sweeps = 20000, .tolerance = 1e-12};

/// Checks both parts of Coulomb's law, and that contacts push. `size` [m/s]: the tolerance times the coupling of the
/// rows.
void expect_coulomb(const System<6>& s, const FrictionContact& contact, double size) {
  const double press = s.rows[contact.normal].lambda, limit = contact.mu * press;
  const Vec2 friction = s.tangential(contact), slip = -s.slip_lacks(contact);
  expect_at_least("λ_n [N s]", "Eq. (4.1)", press, 0, "contacts never pull");
  expect_at_most("residual of a contact [m/s]", "Eq. (4.1)", s.lacks(contact.normal), size,
                 "it presses, or separates");
  expect_at_most("|λ_t| [N s]", "Eq. (9.3)", friction.norm(), limit + 1e-12, "μ λ_n",
                 "Each update of sweep_on_cones keeps friction inside its cone. Is it what sweeps here?");
  if (slip.norm() <= 100 * size || limit <= 100 * size) return;  // it sticks, or has λ_n = 0
  expect_near("|λ_t| of a contact that slides at " + show(slip.norm()) + " m/s, over μ λ_n", "Eq. (9.3)",
              friction.norm() / limit, 1, {size / limit, "the tolerance over μ λ_n"}, {},
              "A sliding contact has |λ_t| = μ λ_n.");
  expect_near("cosine between friction and a slip of " + show(slip.norm()) + " m/s", "Eq. (9.3), (9.6)",
              friction.dot(slip) / (friction.norm() * slip.norm()), -1,
              {1e-9 + size / std::min(slip.norm(), limit), "the tolerance over slip and limit"}, {},
              "The friction of a sliding contact opposes the slip.");
}

EXERCISE_TEST(ConeSolve, FindsCoulombsLaw) {
  Random random;
  for (int trial = 0; trial < 10 && !::testing::Test::HasFailure(); ++trial) {
    System<6> s = random_system(random, 4, 4, 0.3);
    const SolveReport report = cone_solve(s.contacts, s.rows, s.V, long_and_sharp);
    expect_true("4 contacts and 5 joints' rows, μ up to 0.3, have converged in 20000 sweeps", "Eq. (4.9)",
                report.converged, "`converged` tells whether the last sweep returned at most the tolerance.");
    expect_near_vector("V after it", "Eq. (4.5)", all_V(s.V), V_of_lambda(s.rows, s.V.size()),
                       {1e-10, "roundings of up to 20000 sweeps"},
                       {{Eigen::VectorXd::Zero(6 * std::ssize(s.V)),
                         "V has not changed, but λ has. Has a copy of V been swept?"}});
    for (const FrictionContact& contact : s.contacts) expect_coulomb(s, contact, 1e-10);
  }
}

// Cones and the stop rule together: when contacts begin to slide, or stick again, a sweep may return more than
// the one before.
EXERCISE_TEST(ConeSolve, GoesOnWhenASweepReturnsMore) {
  Random random;
  Regions regions({"a sweep returns more than the one before"}, 10);
  while (regions.lack_draws()) {
    const System<6> s = random_system(random, 4, 4, 1);
    System<6> swept = s;
    std::vector<double> by_hand;
    for (int k = 0; k < 12; ++k) by_hand.push_back(sweep_on_cones(swept.contacts, swept.rows, swept.V));
    const bool more = one_returns_more(by_hand);
    regions.draw({{"a sweep returns more than the one before", more}});
    const auto anew = [&](const StopRule& stop) {
      System<6> again = s;
      return cone_solve(again.contacts, again.rows, again.V, stop);
    };
    if (more) expect_goes_on_when_one_returns_more("Eq. (4.9)", by_hand, anew);
  }
}

EXERCISE_TEST(ConeSolve, WithoutContactsEqualsSolve) {
  Random random;
  System<6> s = random_bodies(random, 3);
  for (int k = 0; k < 4; ++k) add_random_joint(s, random);
  System<6> plain = s;
  const StopRule stop{.max_sweeps = 20, .tolerance = 1e-9};
  const SolveReport report = cone_solve(s.contacts, s.rows, s.V, stop),
                    expected = solve(plain.rows, plain.V, stop);
  expect_true(
      "four joints' rows and no contact take " + std::to_string(expected.history.size()) + " sweeps, and not " +
          std::to_string(report.history.size()),
      "Eq. (4.9)", report.history.size() == expected.history.size() && report.converged == expected.converged,
      report.history.empty() ? "Sweep the rows of joints, too. Return early only if there are no rows."
                             : "Append what each sweep returns. The first entry that is at most the tolerance "
                               "is the last.");
  expect_near_vector("λ of four joints' rows after it [N s]", "Eq. (4.7)", all_lambda(s.rows),
                     all_lambda(plain.rows), roundings(1e4, 5), {},
                     "Without contacts it is chapter 04's solve.");
}

EXERCISE_TEST(ConeSolve, NeverAddsEnergy) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    System<6> s = random_bodies(random, 4);
    for (int k = 0; k < 4; ++k) add_random_contact(s, random, 0.3);
    cone_solve(s.contacts, s.rows, s.V, long_and_sharp);
    double change = 0;  // W·M V + V·M V/2, and M V is the sum of the rows' impulses, Gᵀ λ
    for (const Row<6>& row : s.rows)
      change += row.lambda * (row.Gi.dot(s.motion.W[row.i] + s.V[row.i] / 2) +
                              row.Gj.dot(s.motion.W[row.j] + s.V[row.j] / 2));
    expect_at_most("energy that four contacts without a gap add to four bodies [J]", "Eq. (9.9)", change, 1e-10,
                   "0, within the tolerance", "Friction opposes the slip, and contacts do not bounce.");
  }
}

EXERCISE_TEST(ConeSolve, HoldsAStackFromTanThetaOn) {
  Random random;
  for (int n = 1; n <= 5; ++n) {
    const double slope = random.uniform(0.1, 1), h = 0.01, turn = random.uniform(0, 6);
    const std::string stack = std::to_string(n) + " points, one on the other, on a slope of " + show(slope) +
                              " rad, tangents turned by " + show(turn);
    System<3> s = points_on_a_slope(n, slope, 1.001 * std::tan(slope), turn, h), sliding;
    cone_solve(s.contacts, s.rows, s.V, {.max_sweeps = 20000, .tolerance = 1e-13});
    for (std::size_t k = 1; k < s.V.size(); ++k)
      expect_at_most("speed of one of " + stack + ", μ = 1.001 tan θ [m/s]", "Eq. (9.3)", s.velocity(k).norm(),
                     1e-10, "0: they stick; the tolerance times the condition of their S");
    sliding = points_on_a_slope(n, slope, 0.9 * std::tan(slope), turn, h);
    cone_solve(sliding.contacts, sliding.rows, sliding.V, {.max_sweeps = 20000, .tolerance = 1e-13});
    for (std::size_t k = 1; k < s.V.size(); ++k)
      expect_near_vector("velocity of one of " + stack + ", μ = 0.9 tan θ [m/s]", "Eq. (9.3)",
                         Vec3(sliding.velocity(k)), Vec3(0.1 * h * g * std::sin(slope), 0, 0),
                         {1e-10, "the tolerance times the condition of their S"},
                         {{Vec3::Zero(),
                           "It sticks, although the cone is not wide enough. A friction box is, along its "
                           "diagonals."}},
                         "Straight downhill, at h (g sin θ - μ g cos θ), for any tangents.");
  }
}

/// A thin plate of 1 kg that spins about z on points that carry it evenly, with 1/3 of its inertia across.
struct Plate {
  std::vector<Vec3> points;
  double inertia, mu, h, omega;

  void step() {
    System<6> s;
    add_body<6>(s, {});
    const Vec3 zero = Vec3::Zero(), up = Vec3::UnitZ(), inverse(2 / inertia, 2 / inertia, 1 / inertia);
    add_body<6>(s, {.linear = 1, .angular = inverse.asDiagonal()}, (Twist<6>() << zero, 0, 0, omega).finished(),
                (Twist<6>() << 0, 0, -h * g, zero).finished());
    for (const Vec3& r : points)
      add_contact(s, {.i = 0, .j = 1, .n = up, .gap = 0, .r_i = r, .r_j = r}, {Vec3::UnitX(), Vec3::UnitY()},
                  mu);
    for (const FrictionContact& contact : s.contacts)
      s.begin_with(contact.normal, h * g / static_cast<double>(points.size()));
    cone_solve(s.contacts, s.rows, s.V, {.max_sweeps = 200, .tolerance = 1e-14});
    omega = s.velocity(1)[5];
  }
};

double mean(const std::vector<Vec3>& points, double (*of)(const Vec3&)) {
  double sum = 0;
  for (const Vec3& r : points) sum += of(r);
  return sum / static_cast<double>(points.size());
}

EXERCISE_TEST(ConeSolve, StopsASpinningDiscWhereItShould) {
  const int n = 40;
  const double h = 1.0 / 60, mu = 0.4, radius = 0.5, inertia = radius * radius / 2, omega0 = 30;
  Plate disc{.points = {}, .inertia = inertia, .mu = mu, .h = h, .omega = omega0};
  for (int k = 0; k < n; ++k) {  // spaced as in a sunflower, each with an opposite point, and each with equal
                                 // area
    const double angle = 2.399963 * k, r = radius * std::sqrt((k + 0.5) / n);
    const Vec3 point(r * std::cos(angle), r * std::sin(angle), 0);
    disc.points.push_back(point);
    disc.points.push_back(-point);
  }
  const double arm = mean(disc.points, [](const Vec3& r) { return r.norm(); });
  const double box_arm = mean(disc.points, [](const Vec3& r) { return std::abs(r.x()) + std::abs(r.y()); });
  disc.step();
  expect_near("spin lost in the first step [rad/s]", "Eq. (9.11)", omega0 - disc.omega,
              mu * g * h * arm / inertia, {1e-11, "the tolerance of each of 80 contacts, over the inertia"},
              {{mu * g * h * box_arm / inertia,
                "This is a box of ±μ λ_n, 4/π times too much. Coulomb's disc has no corners."},
               {0, "It has not been slowed. Does the friction use λ_n?"}},
              "μ m g h times the mean distance from the centre, over the inertia.");
  int steps = 1;
  while (std::abs(disc.omega) > 1e-9 && steps < 1000) {
    disc.step();
    ++steps;
  }
  const double time = 3 * radius * omega0 / (4 * mu * g);
  expect_near("time until it rests [s]", "Eq. (9.11)", steps * h, time,
              {1.5 * h + 0.002 * time, "a step and a half, and 0.2 % for 80 points in place of an area"}, {},
              "3 R ω0/(4 μ g).");
}

EXERCISE_TEST(ConeSolve, SlowsASpinningPlateByItsMeanDistance) {
  const int n = 20;
  const double h = 1.0 / 60, mu = 0.4, a = 0.5, inertia = 2 * a * a / 3, omega0 = 30;
  Plate plate{.points = {}, .inertia = inertia, .mu = mu, .h = h, .omega = omega0};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      plate.points.emplace_back(a * ((2 * i + 1.0) / n - 1), a * ((2 * j + 1.0) / n - 1), 0);
  plate.step();
  const double arm = a * (std::numbers::sqrt2 + std::log(1 + std::numbers::sqrt2)) / 3;
  expect_near("spin lost in one step by a square plate of 1 m on 400 points [rad/s]", "Eq. (9.12)",
              omega0 - plate.omega, mu * g * h * arm / inertia,
              {2e-3 * mu * g * h * arm / inertia, "0.2 % for 400 points in place of an area"},
              {{mu * g * h * a / inertia, "This is a box of ±μ λ_n: 31 % too much, at this attitude."}},
              "Mean distance from the centre, a (√2 + ln(1 + √2))/3.");
}

EXERCISE_TEST(ConeSolve, SlowsABlockAlikeInAllDirections) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    const double mu = random.uniform(0.1, 1), h = 0.01, phi = random.uniform(0, 2 * std::numbers::pi);
    System<3> s;
    const Vec3 zero = Vec3::Zero(), up = Vec3::UnitZ(), v = Vec3(std::cos(phi), std::sin(phi), 0);
    add_body<3>(s, {});
    add_body<3>(s, {.linear = 0.5}, v, -h * g * up);
    add_contact(s, {.i = 0, .j = 1, .n = up, .gap = 0, .r_i = zero, .r_j = zero},
                {Vec3::UnitX(), Vec3::UnitY()}, mu);
    cone_solve(s.contacts, s.rows, s.V, long_and_sharp);
    const double loss = mu * g * h;
    expect_near_vector(
        "speed lost in a step by a block that slides at an angle of " + show(phi) + " to t1, over μ g h",
        "Eq. (9.3)", Vec3((v - s.velocity(1)) / loss), v, roundings(1e4),
        {{Vec3(std::copysign(1, v.x()), std::copysign(1, v.y()), 0),
          "This is a box: μ g h along each tangent."}},
        "μ g h, against its motion.");
  }
}

EXERCISE_TEST(ConeSolve, ReportsSweepsThatCycle) {
  // μ n·Kt/n·Kn = -1.5: friction lifts more than the contact presses, so λ_n alternates with 0.
  System<6> s = leaning_rod(2, 3, 0.16);
  const SolveReport report = cone_solve(s.contacts, s.rows, s.V, {.max_sweeps = 1000, .tolerance = 1e-6});
  expect_true(
      "a rod that is dragged with μ = 2 has not converged after 1000 sweeps", "Eq. (9.8), (4.9)",
      !report.converged && report.history.size() == 1000,
      "The sweeps alternate between two values for ever, and neither is a solution. Then `converged` is false, "
      "and the history shows this.");
  if (report.history.empty()) return;
  expect_at_least("what its last sweep returned [m/s]", "Eq. (9.8)", report.history.back(), 0.16,
                  "λ_n alternates with 0: 0.16 m/s at least");
}

EXERCISE_TEST(ConeSolve, BeginsWithWhatIsThere) {
  Random random;
  System<6> s = random_system(random, 4, 4, 0.3);
  cone_solve(s.contacts, s.rows, s.V, long_and_sharp);
  System<6> again = s;
  const SolveReport report =
      cone_solve(again.contacts, again.rows, again.V, {.max_sweeps = 100, .tolerance = 1e-10});
  expect_true(
      "begun at a solution it is done after one sweep, and not " + std::to_string(report.history.size()),
      "Eq. (4.9)", report.converged && report.history.size() == 1,
      "λ and V are a warm start. Do not set them to zero.");
  expect_near_vector("λ, begun at a solution [N s]", "Eq. (4.9)", all_lambda(again.rows), all_lambda(s.rows),
                     {1e-9, "one sweep of the tolerance"});
}

EXERCISE_TEST(ConeSolve, RemembersWhatEachSweepReturnedAndStops) {
  System<6> s = leaning_rod(0.5, -3, 0.16), by_hand = s;
  const SolveReport report = cone_solve(s.contacts, s.rows, s.V, {.max_sweeps = 1000, .tolerance = 1e-6});
  std::vector<double> expected, residuals;
  do {
    expected.push_back(sweep_on_cones(by_hand.contacts, by_hand.rows, by_hand.V));
    residuals.push_back(residual_on_cones(by_hand.contacts, by_hand.rows, by_hand.V));
  } while (!(expected.back() <= 1e-6) && expected.size() < 1000);
  for (std::size_t k = 0; k < std::min(expected.size(), report.history.size()); ++k)
    expect_near(
        "entry " + std::to_string(k) + " of the history [m/s]", "Eq. (4.9)", report.history[k], expected[k],
        roundings(1000),
        {{residuals[k],
          "This is the residual after the sweep. The history and the stop rule have what sweep_on_cones "
          "returned."}},
        "What sweep_on_cones returned.");
  expect_true(
      "it made " + std::to_string(expected.size()) + " sweeps to a tolerance of 1e-6 m/s, and not " +
          std::to_string(report.history.size()),
      "Eq. (4.9)", report.history.size() == expected.size(),
      "The first sweep that returns at most the tolerance is the last one, and each sweep adds an entry "
      "to the history.");
  expect_true("it converged", "Eq. (4.9)", report.converged);

  System<6> few = leaning_rod(0.5, -3, 0.16);
  const SolveReport short_one = cone_solve(few.contacts, few.rows, few.V, {.max_sweeps = 4, .tolerance = 1e-6});
  expect_true("4 sweeps at most: 4 entries, not converged", "Eq. (4.9)",
              short_one.history.size() == 4 && !short_one.converged);

  // On the bound exactly: "at most" counts.
  System<6> level = leaning_rod(0.5, -3, 0.16);
  const SolveReport at = cone_solve(level.contacts, level.rows, level.V,
                                    {.max_sweeps = 1000, .tolerance = expected[expected.size() / 2]});
  expect_true("a sweep that returns the tolerance itself is good enough", "Eq. (4.9)",
              at.history.size() == expected.size() / 2 + 1, "At most the tolerance: <=.");
}

EXERCISE_TEST(ConeSolve, StopsByTheRule) {
  Random random;
  for (const double size : {1e-3, 1.0, 1e3}) {  // a factor of B: the tolerance is a velocity, and not relative
                                                // to B
    System<6> s = random_system(random, 10, 6, 0.5);
    for (Row<6>& row : s.rows) row.B *= size;
    const auto anew = [&](const StopRule& stop) {
      System<6> again = s;
      return cone_solve(again.contacts, again.rows, again.V, stop);
    };
    if (!expect_stops_by_the_rule("Eq. (4.9)", 12, anew)) return;
  }
}

EXERCISE_TEST(ConeSolve, RefusesABadStopRule) {
  System<3> s = points_on_a_slope(1, 0.1, 0.5, 0, 0.1), none;
  expect_rejects(
      "a rule of no sweeps", "max_sweeps",
      [&] { cone_solve(s.contacts, s.rows, s.V, {.max_sweeps = 0, .tolerance = 0}); }, "",
      state_of(s.rows, s.V));
  const auto with = [](System<3> system, int max_sweeps, double tolerance) {
    cone_solve(system.contacts, system.rows, system.V, {.max_sweeps = max_sweeps, .tolerance = tolerance});
  };
  expect_rejects("a rule of no sweeps", "max_sweeps", [&] { with(s, 0, 0); });
  expect_rejects("a negative tolerance", "tolerance", [&] { with(s, 5, -1); });
  expect_rejects("a tolerance of NaN", "tolerance", [&] { with(s, 5, std::nan("")); });
  expect_rejects("an infinite tolerance", "tolerance", [&] { with(s, 5, infinity); });
  expect_rejects("a rule of no sweeps, without rows", "max_sweeps", [&] { with(none, 0, 0); });
  const SolveReport report = cone_solve(none.contacts, none.rows, none.V, {.max_sweeps = 5, .tolerance = 0});
  expect_true("without rows it has converged without a sweep", "Eq. (4.9)",
              report.converged && report.history.empty(),
              "Without rows the system is solved: `converged` starts as rows.empty().");
  s.rows[0].B = std::nan("");
  const SolveReport broken = cone_solve(s.contacts, s.rows, s.V, {.max_sweeps = 5, .tolerance = 1});
  expect_true("a NaN has not converged, and is swept 5 times of 5 at most", "Eq. (4.9)",
              !broken.converged && broken.history.size() == 5,
              "Test for at most the tolerance. Every comparison with NaN is false.");
}

}  // namespace
