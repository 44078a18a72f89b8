// Rows in, solution out: wires, stacks, towers, and rows that are redundant or contradictory.
#include <numeric>

#include "algebra.hpp"
#include "exercise_test.hpp"
#include "regions.hpp"
#include "stop_rule.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(DirectSolve, "11.11 direct_solve");

template <int Dof>
SolveReport solve_directly(System<Dof>& s, const StopRule& stop = exact) {
  Factors factors;
  return direct_solve(s.rows, s.V, stop, factors);
}

void expect_solved(const std::string& what, const SolveReport& report) {
  expect_true(what + ": solved, and without trouble", "Eq. (11.13)", report.converged && report.trouble.empty(),
              report.trouble.empty() ? "" : "It reports: " + report.trouble + ".");
}

EXERCISE_TEST(DirectSolve, HoldsAWireWithALoad) {
  for (const double ratio : {1.0, 1e3, 1e5}) {
    const HangingWire wire{.links = 100, .ratio = ratio, .k = 1e8, .h = 1.0 / 60};
    System<3> s = wire.system();
    const SolveReport report = solve_directly(s);
    const std::string what = "100 links, " + show(ratio) + ":1";
    expect_solved(what, report);
    expect_near("factorisations, " + what, "Eq. (11.3)", static_cast<double>(report.history.size()), 1,
                {0, "without bounds one factorisation suffices"});
    double worst = 0;
    for (int link = 0; link < wire.links; ++link) {
      const double right = -wire.h * wire.tension(link);
      const double error = std::abs(s.rows[static_cast<std::size_t>(link)].lambda / right - 1);
      if (!(error <= worst)) worst = error;
    }
    expect_at_most("largest relative error of λ, " + what, "Eq. (6.8)", worst, 1e-8,
                   "1e-16 times the condition, which Σ bounds by 1e7");
  }
}

EXERCISE_TEST(DirectSolve, LeavesTheVelocitiesOfItsImpulses) {
  Random random;
  System<6> s = random_system(random, 5, 8);
  add_random_bounds(random, s.rows);
  s.rows[3].lo = s.rows[3].hi = 0.25;
  System<6> warm = s;
  solve_directly(s);
  expect_near("largest difference of V and M⁻¹Gᵀλ [m/s, rad/s]", "Eq. (4.5)",
              difference(s.V, velocities(s.rows, s.V.size())), 0, roundings(100, 5), {},
              "V contains every row's λ, also of one with lo = hi. Refine only where all λ are within their "
              "bounds: a λ that is clamped changes V by less.");
  for (Row<6>& row : warm.rows) row.lambda = random.uniform(-5, 5);
  for (Twist<6>& V : warm.V) V.setConstant(random.uniform(-5, 5));
  solve_directly(warm);
  expect_near("largest difference of V when rows and V held other values on entry [m/s, rad/s]", "Eq. (4.5)",
              difference(warm.V, s.V), 0, {1e-9, "both are solved up to round-off"}, {},
              "Assign V, and ignore λ on entry.");
}

EXERCISE_TEST(DirectSolve, RefinesTheImpulsesToo) {
  const HangingWire wire{.links = 100, .ratio = 1e6, .k = 1e12, .h = 0.01};
  System<3> s = wire.system();
  solve_directly(s);
  double worst = 0;
  for (int link = 0; link < wire.links; ++link) {
    const double right = -wire.h * wire.tension(link);
    const double error = std::abs(s.rows[static_cast<std::size_t>(link)].lambda / right - 1);
    if (!(error <= worst)) worst = error;
  }
  expect_at_most("largest relative error of λ, 100 links of 1e12 N/m, 1e6:1", "Eq. (11.14)", worst, 1e-11,
                 "the remainder of one refinement of 1e-9: its square, and round-off of a hundred rows",
                 "Without refinement the error is 1e-16 times the condition. Add δ to λ as well as to V, with "
                 "the same sign.");
  // One row's bound is next to its λ, nearer than λ was before refinement. The resulting residual is tolerated.
  const System<3> solved = s;
  for (std::size_t k = 0; k < s.rows.size() && !::testing::Test::HasFailure(); ++k)
    for (const double side : {-1.0, 1.0}) {
      s = solved;
      Row<3>& row = s.rows[k];
      (side > 0 ? row.hi : row.lo) = row.lambda - side * 1e-10 * std::abs(row.lambda);
      solve_directly(s, {.max_sweeps = 100, .tolerance = 1e-3});
      expect_true(
          "λ of link " + std::to_string(k) + " is within its bounds, also if refinement would move it out",
          "Eq. (11.14)", row.lo <= row.lambda && row.lambda <= row.hi,
          "λ was within its bounds, and δ moves it out: clamp it again.");
    }
}

EXERCISE_TEST(DirectSolve, StretchesAWireByItsTensions) {
  // The wire starts unstretched: links of 0.01 m and k = 1e10 N/m.
  const HangingWire wire{.links = 100, .ratio = 1e5, .k = 1e10, .h = 1.0 / 60};
  System<3> s = wire.system();
  const double rest = 1.0 / wire.links;
  const SpookParameters spook = spook_parameters(wire.h, wire.k, wire.d);
  std::vector<double> z(s.V.size()), w(s.V.size(), 0.0);
  for (std::size_t point = 0; point < z.size(); ++point) z[point] = -rest * static_cast<double>(point);
  Factors factors;
  for (int step = 0; step < 200; ++step) {
    for (std::size_t k = 0; k < s.rows.size(); ++k) {
      const double gap = z[k] - z[k + 1] - rest, rate = w[k] - w[k + 1];
      const double force = s.motion.Wf[k].z() - s.motion.Wf[k + 1].z();
      s.rows[k].B = -spook.a * gap - spook.b * rate - force;
    }
    direct_solve(s.rows, s.V, exact, factors);
    for (std::size_t point = 0; point < z.size(); ++point) {
      w[point] += s.V[point].z() + s.motion.Wf[point].z();
      z[point] += wire.h * w[point];
    }
  }
  double right = 0;
  for (int link = 0; link < wire.links; ++link) right += wire.tension(link) / wire.k;
  expect_near("stretch of a wire of 1 m after 200 steps, 1e5:1 [m]", "Eq. (6.9)", -z.back() - 1, right,
              {1e-12, "round-off of 100 positions below 1 m, and a decay of 0.8 a step"}, {},
              "The round-off of λ = 1e4 N s moves 1 kg. Solve once more for the remaining residual of the rows "
              "and add the result to V, Eq. (11.14).");
  expect_near("analyses in 200 steps", "Eq. (11.3)", factors.analyses, 1,
              {0, "the pattern is the wire's, and stays"}, {},
              "The factors are an argument, so that the pattern is analysed once.");
}

EXERCISE_TEST(DirectSolve, ClosesAStackOfAnyRatio) {
  // Two point masses on a floor; the upper one is `ratio` times as heavy. It rests N/k deep.
  for (const double ratio : {1e6, 1e8}) {
    const double h = 1.0 / 60, g = 9.81, k = 1e12;
    const SpookParameters spook = spook_parameters(h, k, 2);
    const Twist<3> up(0, 0, 1);
    System<3> s;
    s.add(0, Twist<3>::Zero());
    s.add(1, -h * g * up);
    s.add(1 / ratio, -h * g * up);
    for (int below = 0; below < 2; ++below)
      s.add({.i = below, .j = below + 1, .Gi = -up, .Gj = up, .gap = 0, .spook = spook});
    double gaps[] = {0, 0}, w[] = {0, 0, 0};
    for (int step = 0; step < 300; ++step) {
      for (std::size_t row : {0u, 1u})
        s.rows[row].B = -spook.a * gaps[row] - spook.b * (w[row + 1] - w[row]) -
                        (s.motion.Wf[row + 1].z() - s.motion.Wf[row].z());
      const SolveReport report = solve_directly(s);
      if (!report.converged) return expect_solved("step " + std::to_string(step), report);
      for (std::size_t body : {1u, 2u}) w[body] += s.V[body].z() + s.motion.Wf[body].z();
      for (std::size_t row : {0u, 1u}) gaps[row] += h * (w[row + 1] - w[row]);
    }
    const double lower = (ratio + 1) * g / k, upper = ratio * g / k;
    const std::string what = ", " + show(ratio) + ":1 [m]";
    const Tolerance tolerance{1e-9 * lower, "round-off times the condition, which Σ bounds by 1e8"};
    const std::string clue =
        "Where no bound is active, solve once more for the remaining residual, Eq. (11.14): V += M⁻¹ Gᵀ δ with "
        "δ itself. The difference (λ + δ) - λ has lost the last digits.";
    expect_near("depth at the floor" + what, "Eq. (3.13)", -gaps[0], lower, tolerance, {}, clue);
    expect_near("depth between the two" + what, "Eq. (3.13)", -gaps[1], upper, tolerance, {}, clue);
  }
}

EXERCISE_TEST(DirectSolve, CarriesATowerOfAHundredBoxes) {
  const double h = 1.0 / 60, g = 9.81;
  System<6> s = box_tower(100, h, 0.5, Vec3::Zero());
  const SolveReport report = solve_directly(s);
  expect_solved("1200 rows", report);
  expect_near("factorisations for a tower at rest", "Eq. (11.3)", static_cast<double>(report.history.size()), 1,
              {0, "no bound is active: one suffices"}, {},
              "First solve without bounds, and test whether the solution satisfies them.");
  double worst = 0;
  for (std::size_t box = 0; box < 100; ++box) {
    double sum = 0;
    for (std::size_t contact = 0; contact < 4; ++contact) sum += s.rows[12 * box + 3 * contact].lambda;
    const double error = std::abs(sum / (h * g * static_cast<double>(100 - box)) - 1);
    if (!(error <= worst)) worst = error;
  }
  expect_at_most("largest relative error of the impulses under a box", "Eq. (4.1)", worst, 2.5e-5,
                 "Σ n²/4: Σ lets the top sink at Σ n²/8 of h g");
}

EXERCISE_TEST(DirectSolve, LetsATowerSlide) {
  const double h = 1.0 / 60, g = 9.81, mu = 0.3;
  System<6> s = box_tower(10, h, mu, Vec3(3, 1, 0));
  const SolveReport report = solve_directly(s);
  expect_solved("120 rows, with friction at its bounds", report);
  expect_at_most("residual, with all zeros of S written down [m/s]", "Eq. (4.8)",
                 dense_residual(bounded(s.rows), gathered(s.rows, &Row<6>::lambda)), 1e-11,
                 "roundings of 120 rows");
  double friction = 0;
  for (std::size_t contact = 0; contact < 4; ++contact) friction += s.rows[3 * contact + 1].lambda;
  expect_near("friction of the floor along x, over its bound", "Eq. (5.7)", friction / (mu * h * g * 10), -1,
              {1e-12, "equal to its bound"}, {}, "It slides at 3 m/s: friction cannot stop it in one step.");
}

EXERCISE_TEST(DirectSolve, AgreesWithManySweeps) {
  Random random;
  Regions regions({"a row is held at a lower bound of 0", "a row is held at an upper bound of 0",
                   "a row is held at a lower bound", "a row is held at an upper bound"});
  while (regions.lack_draws()) {
    System<6> s = random_system(random, 5, 8);
    add_random_bounds(random, s.rows);
    System<6> swept = s;
    solve(swept.rows, swept.V, {.max_sweeps = 200000, .tolerance = 1e-14});
    const auto held = [&](double Row<6>::*bound, bool zero) {
      return std::any_of(swept.rows.begin(), swept.rows.end(), [&](const Row<6>& row) {
        return row.lambda == row.*bound && (row.lambda == 0) == zero;
      });
    };
    regions.draw({{"a row is held at a lower bound of 0", held(&Row<6>::lo, true)},
                  {"a row is held at an upper bound of 0", held(&Row<6>::hi, true)},
                  {"a row is held at a lower bound", held(&Row<6>::lo, false)},
                  {"a row is held at an upper bound", held(&Row<6>::hi, false)}});
    const SolveReport report = solve_directly(s);
    expect_solved("8 rows with bounds", report);
    expect_near_vector(
        "λ, against sweeps to 1e-14 m/s [N s]", "Eq. (4.1)", gathered(s.rows, &Row<6>::lambda),
        gathered(swept.rows, &Row<6>::lambda),
        {1e-11 * condition(dense_S(s.rows)), "the residual of Eq. (11.13) times the condition of S"}, {},
        "Hold each row at its own bounds, and use the impulse there; a bound of 0 is one, too.");
  }
}

EXERCISE_TEST(DirectSolve, StopsWhenClampingMeetsTheTolerance) {
  Random random;
  for (int met = 0; met < 10;) {
    System<6> s = random_system(random, 4, 6);
    const VectorXd free = solution_of(bounded(s.rows).S, bounded(s.rows).B);
    s.rows[2].hi = free[2] - 1e-5;
    VectorXd clamped = free;
    clamped[2] = s.rows[2].hi;
    System<6> to_roundings = s;
    const double residual = dense_residual(bounded(s.rows), clamped);
    if (residual < 1e-7) continue;  // a row that shares no body: clamping it gives the solution
    ++met;
    const SolveReport report = solve_directly(s, {.max_sweeps = 100, .tolerance = 2 * residual});
    expect_solved("a row whose λ exceeds its bound by 1e-5 N s, with a tolerance of twice that residual",
                  report);
    expect_near("factorisations, where clamping the solution without bounds suffices", "Eq. (4.9)",
                static_cast<double>(report.history.size()), 1, {0, "a count"});
    expect_near("λ of the row that exceeded its bound [N s]", "Eq. (4.1)", s.rows[2].lambda, s.rows[2].hi,
                {0, "exact"});
    const SolveReport fine = solve_directly(to_roundings);
    expect_solved("equal, up to round-off", fine);
    if (fine.history.empty()) return;
    expect_near("first entry of the history, over the residual of the clamped solution without bounds",
                "Eq. (4.8)", fine.history.front() / residual, 1, {1e-6, "round-off of λ over the 1e-5 N s"}, {},
                "Clamp λ to its bounds, compute V from it, and then test the residual.");
  }
}

EXERCISE_TEST(DirectSolve, HoldsRowsWithEqualBounds) {
  Random random;
  for (int repeat = 0; repeat < 10; ++repeat) {
    System<6> s = random_system(random, 4, 6);
    add_random_bounds(random, s.rows);
    s.rows[1].lo = s.rows[1].hi = 0;
    s.rows[4].lo = s.rows[4].hi = random.uniform(-0.5, 0.5);
    const SolveReport report = solve_directly(s);
    expect_solved("rows of which two have lo = hi", report);
    for (const std::size_t k : {1u, 4u})
      expect_near("λ of a row with lo = hi [N s]", "Eq. (4.1)", s.rows[k].lambda, s.rows[k].lo, {0, "exact"});
    expect_at_most("residual, with all zeros of S written down [m/s]", "Eq. (4.8)",
                   dense_residual(bounded(s.rows), gathered(s.rows, &Row<6>::lambda)), 1e-12, "roundings",
                   "Apply the impulse of a row with lo = hi to the bodies before you solve for the other rows: "
                   "it is there before the others are solved.");
  }
  System<6> all = random_system(random, 4, 3);
  for (Row<6>& row : all.rows) row.lo = row.hi = 0.1;
  const SolveReport report = solve_directly(all);
  expect_solved("rows that all have lo = hi", report);
  expect_near_vector("their λ [N s]", "Eq. (4.1)", gathered(all.rows, &Row<6>::lambda),
                     VectorXd::Constant(3, 0.1), {0, "exact"}, {},
                     "Also if no row is left to solve, each has its λ, and V is set.");
  expect_near("largest difference of V and M⁻¹Gᵀλ, where all rows have lo = hi [m/s, rad/s]", "Eq. (4.5)",
              difference(all.V, velocities(all.rows, all.V.size())), 0, roundings(100, 5), {},
              "Also if no row is left to solve, V contains every row's λ.");
}

EXERCISE_TEST(DirectSolve, WeighsContradictionsByStiffness) {
  Random random;
  for (int repeat = 0; repeat < 10; ++repeat) {
    // Two springs between a point and the wall, of lengths l1 and l2. At rest their forces cancel.
    const double k1 = random.log_uniform(1e2, 1e6), k2 = random.log_uniform(1e2, 1e6);
    const double l1 = random.uniform(0.5, 1), l2 = random.uniform(1, 2), h = 0.01;
    const double x = (k1 * l1 + k2 * l2) / (k1 + k2);
    System<3> s;
    s.add(0, Twist<3>::Zero());
    s.add(0.5, Twist<3>::Zero());
    const Twist<3> out(1, 0, 0);
    for (const auto& [k, l] : {std::pair{k1, l1}, std::pair{k2, l2}})
      s.add({.i = 0,
             .j = 1,
             .Gi = -out,
             .Gj = out,
             .gap = x - l,
             .spook = spook_parameters(h, k, 2),
             .lo = -infinity,
             .hi = infinity});
    const SolveReport report = solve_directly(s);
    expect_solved("two lengths for one distance", report);
    const double force = k1 * (l1 - x);
    const Tolerance tolerance{1e-8 * std::abs(force) * h, "round-off over Σ, times S"};
    expect_near("λ of the first, at the mean length weighted by the stiffnesses [N s]", "Eq. (11.1)",
                s.rows[0].lambda, h * force, tolerance);
    expect_near("λ of the second [N s]", "Eq. (11.1)", s.rows[1].lambda, -h * force, tolerance);
  }
}

EXERCISE_TEST(DirectSolve, SharesAmongAHundredContacts) {
  const double h = 1.0 / 60, g = 9.81;
  System<6> s = box_tower(1, h, 0, Vec3::Zero());
  const Constraint<6> contact{.i = 0,
                              .j = 1,
                              .Gi = s.rows[0].Gi,
                              .Gj = s.rows[0].Gj,
                              .gap = 0,
                              .spook = {.a = 0, .b = 1, .Sigma = 1e-6}};
  s.rows.clear();
  for (int x = 0; x < 10; ++x)
    for (int y = 0; y < 10; ++y) {
      Constraint<6> one = contact;
      const Vec3 r_j((x - 4.5) / 9, (y - 4.5) / 9, -0.5);
      one.Gj.tail<3>() = r_j.cross(Vec3(0, 0, 1));
      s.add(one);
    }
  const SolveReport report = solve_directly(s);
  expect_solved("a box on 100 contacts", report);
  for (const Row<6>& row : s.rows)
    expect_near("λ of one of 100 contacts under a box, over h m g/100", "Eq. (11.1)",
                100 * row.lambda / (h * g), 1, {1e-6, "Σ/100 against S, and round-off over Σ"}, {},
                "The contacts are equally stiff and evenly placed: each carries the same share.");
}

EXERCISE_TEST(DirectSolve, ReportsWhatItCannotDo) {
  // The same row twice, with Σ = 0 and different right sides.
  System<3> s;
  s.add(0, Twist<3>::Zero());
  s.add(1, Twist<3>::Zero());
  const Twist<3> out(1, 0, 0);
  for (const double gap : {-0.01, 0.02})
    s.add({.i = 0,
           .j = 1,
           .Gi = -out,
           .Gj = out,
           .gap = gap,
           .spook = {.a = 1, .b = 1, .Sigma = 0},
           .lo = -infinity,
           .hi = infinity});
  const SolveReport report = solve_directly(s, {.max_sweeps = 20, .tolerance = 0});
  expect_true("contradictory rows have not converged", "Eq. (11.4)", !report.converged);
  expect_true("a factorisation that failed is reported", "Eq. (11.4)", !report.trouble.empty(),
              "The sweeps that follow are a second best: `trouble` gives the reason.");
  expect_true("λ is finite", "Eq. (11.4)", gathered(s.rows, &Row<3>::lambda).allFinite(),
              "Do not solve with factors of a failed factorisation.");
  expect_near("sweeps that follow", "Eq. (4.9)", static_cast<double>(report.history.size()), 20,
              {0, "max_sweeps, and no factorisation"}, {},
              "Continue with chapter 04's solve, and append its history.");

  // With equal right sides the matrix is singular, too, but the first sweep solves the rows.
  for (Row<3>& row : s.rows) row.B = 0.01, row.lambda = 0;
  const SolveReport agreeing = solve_directly(s, {.max_sweeps = 20, .tolerance = 1e-12});
  expect_true("the same row twice: a factorisation that failed is reported", "Eq. (11.4)",
              !agreeing.trouble.empty(), "Its sweeps succeed, but it needed them: `trouble` gives the reason.");
  expect_true("the same row twice: the sweeps that follow have converged", "Eq. (4.9)", agreeing.converged,
              "Where sweeps follow, `converged` is theirs, not that of interior_solve.");
}

EXERCISE_TEST(DirectSolve, SweepsOnWhenStoppedEarly) {
  Random random;
  System<6> s = random_system(random, 12, 30);
  add_random_bounds(random, s.rows);
  const SolveReport report = solve_directly(s, {.max_sweeps = 2, .tolerance = 0});
  expect_true("2 factorisations do not suffice, and `trouble` says so", "Eq. (11.13)", !report.trouble.empty(),
              "interior_solve gives the reason in its `trouble`: pass it on.");
  expect_near(
      "entries of the history", "Eq. (4.9)", static_cast<double>(report.history.size()), 5,
      {0, "one without bounds, two of interior_solve, two sweeps"},
      {{4,
        "An entry is missing. Did the attempt without bounds use one of interior_solve's factorisations? Or "
        "did the sweeps get only the rest of max_sweeps? Each of the three gets the whole rule to itself."},
       {3,
        "Chapter 04's solve goes on from there. The history has the entries of all three: without bounds, "
        "interior_solve, sweeps."}},
      "Chapter 04's solve goes on from there, under the same rule, and its history is appended.");
  expect_near("largest difference of V and M⁻¹Gᵀλ [m/s, rad/s]", "Eq. (4.5)",
              difference(s.V, velocities(s.rows, s.V.size())), 0, roundings(200, 5));
}

EXERCISE_TEST(DirectSolve, StartsTheInteriorSolveFromItsFirstTry) {
  Random random;
  for (int repeat = 0; repeat < 5 && !::testing::Test::HasFailure(); ++repeat) {
    System<6> s = random_system(random, 12, 30);
    add_random_bounds(random, s.rows);
    for (Row<6>& row : s.rows)
      row.B *= 0.01, row.hi = row.lo < 0 ? row.hi : infinity;  // the bounds determine more than B
    s.rows[0].B *= 1e4;
    const Bounded p = bounded(s.rows);
    const auto first_of = [&](const VectorXd& guess) {
      Vector lambda = guess;
      Factors factors;
      const auto history = interior_solve(lower_triangle(p.S), p.B, p.lo, p.hi,
                                          {.max_sweeps = 2, .tolerance = 0}, lambda, factors)
                               .history;
      return history.empty() ? std::nan("") : history[0];
    };
    const double right = first_of(solution_of(p.S, p.B)), from_zero = first_of(VectorXd::Zero(p.B.size()));
    const SolveReport report = solve_directly(s, {.max_sweeps = 2, .tolerance = 0});
    expect_true("the history has the attempt without bounds, and the residuals of interior_solve", "Eq. (4.9)",
                report.history.size() > 2,
                "Append an entry after each factorisation: the first is that without bounds.");
    if (report.history.size() < 2) return;
    expect_near(
        "the residual after interior_solve's first factorisation, the second entry of the history [m/s]",
        "Eq. (11.12)", report.history[1], right, {1e-7 * right, "the condition of S, times round-off"},
        {{from_zero,
          "interior_solve has begun with a guess of 0. The λ of the attempt without bounds is a better guess: "
          "it shows how large the impulses may be."}},
        "interior_solve gets S, B and the bounds of the rows, and as its guess the λ of the attempt without "
        "bounds.");
  }
}

EXERCISE_TEST(DirectSolve, SolvesNearlyEqualRows) {
  // Rows that differ by 1e-13: without bounds their impulses are 1e9 N s. Clamping these does not give the solution.
  for (const bool turned : {false, true}) {
    System<3> s;
    s.add(0, Twist<3>::Zero());
    s.add(1, Twist<3>::Zero());
    const Twist<3> up(0, 0, 1);
    for (const bool first : {!turned, turned}) {
      s.add({.i = 0,
             .j = 1,
             .Gi = -up,
             .Gj = up,
             .gap = first ? -1 - 5e-4 : -1 + 5e-4,
             .spook = {.a = 1, .b = 1, .Sigma = 1e-13},
             .lo = 0,
             .hi = first ? 1 - 5.2e-4 : 1});
    }
    const SolveReport report = solve_directly(s);
    expect_at_most("residual [m/s]", "Eq. (4.8)", residual(s.rows, s.V), 1e-11, "roundings",
                   "The round-off of Eq. (11.13) is that of the λ that is returned, within its bounds.");
    expect_solved("rows that are nearly the same", report);
  }
}

EXERCISE_TEST(DirectSolve, EndsWithANaN) {
  Random random;
  for (const bool in_bounds : {false, true}) {
    System<6> s = random_system(random, 4, 5);
    if (in_bounds) add_random_bounds(random, s.rows);
    s.rows[2].B = std::nan("");
    const SolveReport report = solve_directly(s, {.max_sweeps = 20, .tolerance = 1e-6});
    expect_true(
        "a right side with a NaN has not converged", "Eq. (11.13)", !report.converged,
        "std::max, std::min and Eigen's cwiseMax drop a NaN: a bound takes its place. std::clamp keeps it.");
    expect_true("and is reported", "Eq. (11.13)", !report.trouble.empty());
  }
}

EXERCISE_TEST(DirectSolve, RemembersNoCallBefore) {
  // The same contact so many times, Σ = 0: S cannot be factorised, and the solve always starts at zero.
  const auto impulses = [](int contacts) {
    System<3> s;
    s.add(0, Twist<3>::Zero());
    s.add(0.5, Twist<3>(-1, 0, 0));
    const Twist<3> out(1, 0, 0);
    for (int k = 0; k < contacts; ++k)
      s.add({.i = 0,
             .j = 1,
             .Gi = -out,
             .Gj = out,
             .gap = 0,
             .spook = {.a = 1, .b = 1, .Sigma = 0},
             .lo = 0,
             .hi = infinity});
    solve_directly(s);
    Eigen::VectorXd lambda(contacts);
    for (int k = 0; k < contacts; ++k) lambda[k] = s.rows[static_cast<std::size_t>(k)].lambda;
    return lambda;
  };
  const Eigen::VectorXd first = impulses(3), second = impulses(3), other = impulses(7), third = impulses(3);
  expect_near("sum of the impulses of a contact that occurs 7 times [N s]", "Eq. (11.13)", other.sum(), 2,
              {1e-9, "the residual of interior_solve"}, {}, "2 kg lose 1 m/s.");
  for (const Eigen::VectorXd& again : {second, third})
    expect_near_vector("impulses of a contact that occurs 3 times, in a second call [N s]", "Eq. (11.13)",
                       again, first, {0, "equal input, equal result"}, {},
                       "A value is left over from the call before: from a static variable, perhaps.");
  Factors factors;
  for (const double ratio : {1.0, 1e3}) {
    System<3> s = HangingWire{.links = 10, .ratio = ratio, .k = 1e8, .h = 1.0 / 60}.system();
    const SolveReport report = direct_solve(s.rows, s.V, exact, factors);
    expect_near(
        "factorisations of a wire of 10 links with a load of " + show(ratio) +
            ":1, with the factors of the wire before",
        "Eq. (11.3)", static_cast<double>(report.history.size()), 1,
        {0, "without bounds one factorisation suffices"}, {},
        "The pattern is that of the wire before, but the numbers are others: factorise S in every call.");
  }
}

EXERCISE_TEST(DirectSolve, OfNothingIsDone) {
  System<6> s;
  s.V.assign(2, Twist<6>::Constant(3));
  const SolveReport report = solve_directly(s);
  expect_true("no rows: converged, without a factorisation", "Eq. (4.9)",
              report.converged && report.history.empty() && report.trouble.empty());
  expect_near("largest V without rows [m/s, rad/s]", "Eq. (4.5)",
              difference(s.V, std::vector<Twist<6>>(2, Twist<6>::Zero())), 0, {0, "exact"}, {},
              "V is the effect of the impulses: V = 0 without rows.");
  Random random;
  System<6> still = random_system(random, 4, 8);
  for (Row<6>& row : still.rows) row.B = 0;
  expect_near("factorisations of rows with B = 0", "Eq. (11.13)",
              static_cast<double>(solve_directly(still).history.size()), 1, {0, "a count"}, {},
              "λ = 0 has a residual of 0: that is at most a tolerance of 0, and round-off of 0.");
}

EXERCISE_TEST(DirectSolve, RejectsARuleThatCannotBeMet) {
  Random random;
  System<6> s = random_system(random, 3, 2), none;
  solve_directly(s);
  for (const int sweeps : {0, -5})
    expect_rejects(
        "max_sweeps = " + std::to_string(sweeps), "max_sweeps",
        [&] { solve_directly(s, {.max_sweeps = sweeps, .tolerance = 0}); }, "", state_of(s.rows, s.V));
  for (const double tolerance : {-1e-9, std::nan(""), HUGE_VAL})
    expect_rejects(
        "tolerance = " + show(tolerance), "tolerance",
        [&] { solve_directly(s, {.max_sweeps = 5, .tolerance = tolerance}); }, "", state_of(s.rows, s.V));
  expect_rejects("max_sweeps = 0, with no rows", "max_sweeps",
                 [&] { solve_directly(none, {.max_sweeps = 0, .tolerance = 0}); });
}

}  // namespace
