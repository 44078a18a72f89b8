// The second solve of a relaxed substep: rigid rows, from the result of the first solve.
#include "exercise_test.hpp"
#include "random_input.hpp"
#include "stop_rule.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(Relax, "10.9 relax");

/// The rows that relax() has to make, from the same motion, by chapter 04's make_row.
template <int Dof>
std::vector<Row<Dof>> made_rigid(const Problem<Dof>& p,
                                 const SpookParameters& spook = {.a = 0, .b = 1, .Sigma = 0}) {
  std::vector<Row<Dof>> rows;
  for (const Row<Dof>& row : p.rows) {
    rows.push_back(make_row<Dof>({.i = row.i, .j = row.j, .Gi = row.Gi, .Gj = row.Gj, .gap = 0, .spook = spook},
                                 p.motion));
    rows.back().lo = row.lo, rows.back().hi = row.hi, rows.back().lambda = row.lambda;
  }
  return rows;
}

/// The same with a part of the motion missing.
Eigen::VectorXd right_sides_without(Problem<6> p, bool W, bool Wf) {
  if (W) p.motion.W.assign(p.V.size(), Twist<6>::Zero());
  if (Wf) p.motion.Wf.assign(p.V.size(), Twist<6>::Zero());
  return gathered(made_rigid(p), &Row<6>::B);
}

/// A ball of 2 kg, so deep in a floor, falls at 0.1 m/s, and a step adds 0.06 m/s. The first solve is done.
Problem<3> overlapping_ball(double gap) {
  const Twist<3> up(0, 0, 1);
  Problem<3> p;
  p.motion = {.inverse_mass = {{.linear = 0}, {.linear = 0.5}},
              .W = {Twist<3>::Zero(), -0.1 * up},
              .Wf = {Twist<3>::Zero(), -0.06 * up}};
  p.V.assign(2, Twist<3>::Zero());
  p.rows = {make_row<3>(
      {.i = 0, .j = 1, .Gi = -up, .Gj = up, .gap = gap, .spook = {.a = 20, .b = 0.9, .Sigma = 0.25}},
      p.motion)};
  solve(p.rows, p.V, {.max_sweeps = 1, .tolerance = 0});
  return p;
}

EXERCISE_TEST(Relax, KeepsNoVelocityThatClosesAGap) {
  // First solve: B = 20 · 0.02 + 0.9 · 0.1 + 0.06 = 0.55 m/s, S + Σ = 0.75/kg. Relaxed: λ = 0.16/0.5.
  Problem<3> p = overlapping_ball(-0.02);
  const double first = 0.55 / 0.75;
  relax(p.motion, p.rows, p.V, {.max_sweeps = 1, .tolerance = 0});
  expect_near("λ [N s] of a ball that falls into the floor, 0.7333 N s from the first solve", "Eq. (10.15)",
              p.rows[0].lambda, 0.32, roundings(16),
              {{first, "Nothing has been swept, or the B and Σ of the first solve are still in use."},
               {0, "It began with λ = 0, but V has the λ of the first solve. Begin with both."},
               {0.16 / 0.75, "Σ is still there: set it to 0."},
               {first + (0.16 - 0.5 * first) / 0.75, "Σ is still in the diagonal: compute it anew, without Σ."},
               {0.55 / 0.5, "The gap is still in B. Here a = 0, and b = 1."},
               {0.15 / 0.5, "b is 1 here, not that of the first solve: B = -G W - G W_f."},
               {0.1 / 0.5, "W_f is missing in B: -G W - G W_f."},
               {0.06 / 0.5, "W is missing in B: -G W - G W_f."},
               {first + 0.32, "The impulse of the second solve has been added to that of the first."}});
  expect_near("its velocity afterwards, W + W_f + V [m/s]", "Eq. (10.15)",
              (p.motion.W[1] + p.motion.Wf[1] + p.V[1]).z(), 0, roundings(16), {},
              "An active contact keeps no normal velocity. V must be M⁻¹ Gᵀ λ at all times.");

  Problem<3> lift = overlapping_ball(-0.02);
  lift.motion.W[0].z() = 0.2;
  relax(lift.motion, lift.rows, lift.V, {.max_sweeps = 1, .tolerance = 0});
  expect_near(
      "λ [N s] of the ball on a static floor whose velocity is 0.2 m/s upwards", "Eq. (10.15)",
      lift.rows[0].lambda, 0.36 / 0.5, roundings(16),
      {{0.32, "The velocity of the static body is missing. G W has it, although no impulse changes it."}},
      "B = -G W - G W_f, of both bodies.");
}

EXERCISE_TEST(Relax, RemovesTheImpulseOfTheGap) {
  // It moves out faster than it falls: without the gap the contact is inactive.
  Problem<3> p = overlapping_ball(-0.02);
  p.motion.W[1].z() = 0.4;
  relax(p.motion, p.rows, p.V, {.max_sweeps = 1, .tolerance = 0});
  expect_near("λ [N s] of a ball that rises by its own velocity", "Eq. (10.15), (4.7)", p.rows[0].lambda, 0,
              roundings(16), {{-0.34 / 0.5, "A contact does not pull: use the rows' bounds."}},
              "λ may decrease, down to its bound.");
  expect_near("V of the ball [m/s]", "Eq. (10.15), (4.5)", p.V[1].z(), 0, roundings(16), {},
              "Remove the first solve's effect from V, too.");
}

EXERCISE_TEST(Relax, AgreesWithEnumeratedContacts) {
  Random random;
  for (int trial = 0; trial < 25 && !::testing::Test::HasFailure(); ++trial) {
    const int rows = 1 + trial % 6;
    Problem<6> p = random_problem(random, 3 + rows / 2, rows);
    solve(p.rows, p.V, {.max_sweeps = 100, .tolerance = 0});
    const Bounded exact = bounded(made_rigid(p));
    const auto otherwise = [&](const Eigen::VectorXd& B, double Sigma) {
      Bounded other = exact;
      other.B = B;
      other.S.diagonal().array() += Sigma;
      return enumerate_solution(other);
    };
    const Eigen::VectorXd old_B = gathered(p.rows, &Row<6>::B), without_W = right_sides_without(p, true, false),
                          without_Wf = right_sides_without(p, false, true);
    const Bounded soft = bounded(p.rows);
    const double tolerance = 1e-13;
    const SolveReport report = relax(p.motion, p.rows, p.V, {.max_sweeps = 200000, .tolerance = tolerance});
    expect_true("it converged within 200000 sweeps", "Eq. (4.9)", report.converged);
    expect_near_vector(
        "λ of " + std::to_string(rows) + " contacts [N s]", "Eq. (10.15)", lambdas(p),
        enumerate_solution(exact),
        {10 * rows * condition(exact.S) * (tolerance + 1e-14), "residual times condition of S"},
        {{enumerate_solution(soft), "This is the first solve's result: change B, Σ and the diagonal."},
         {otherwise(old_B, 0), "The gap is still in B: -G W - G W_f."},
         {otherwise(without_W, 0), "W is missing in B: -G W - G W_f."},
         {otherwise(without_Wf, 0), "W_f is missing in B: -G W - G W_f."},
         {enumerate_solution({.S = soft.S, .B = exact.B, .lo = exact.lo, .hi = exact.hi}),
          "Σ is still there: set it to 0."}},
        "All sets of active contacts were tried; this is the only solution.");
    expect_near_vector("V, all bodies [m/s, rad/s]", "Eq. (4.5)", flat(p.V), moved(p), roundings(5e4, 10), {},
                       "V is M⁻¹ Gᵀ λ at all times.");
  }
}

EXERCISE_TEST(Relax, LeavesJointsWithoutVelocity) {
  Random random;
  for (int trial = 0; trial < 10 && !::testing::Test::HasFailure(); ++trial) {
    Problem<6> p = random_problem(random, 6, trial == 0 ? many / 10 : 4);
    take_bounds_off(p);
    solve(p.rows, p.V, {.max_sweeps = 10, .tolerance = 0});
    relax(p.motion, p.rows, p.V, {.max_sweeps = 200000, .tolerance = 1e-12});
    for (const Row<6>& row : p.rows) {
      const auto after = [&](int body) -> Twist<6> { return p.motion.W[body] + p.motion.Wf[body] + p.V[body]; };
      // After a sweep that returns 1e-12 later rows still change a row's residual. As |S_kl| <= S_kk, each adds at most
      // 1e-12.
      expect_at_most("speed of a joint's row afterwards [m/s]", "Eq. (10.15)",
                     std::abs(row.Gi.dot(after(row.i)) + row.Gj.dot(after(row.j))),
                     1e-12 * static_cast<double>(3 * p.rows.size()) + roundings(1e4, 10).value,
                     "three times the tolerance for each row, and round-off",
                     "B is -G W - G W_f of both bodies, Σ is 0, and B has no other term for a joint.");
    }
  }
}

EXERCISE_TEST(Relax, BeginsWhereTheFirstSolveEnded) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    const int count = trial == 0 ? many : 8;
    Problem<6> p = random_problem(random, count / 2, count);
    if (trial % 2 == 1)
      for (Row<6>& row : p.rows) give_any_bounds(random, row);
    solve(p.rows, p.V, {.max_sweeps = 20, .tolerance = 0});
    Problem<6> from_zero = p, once = p, soft_friction = p;
    once.rows = made_rigid(p);
    for (std::size_t k = 0; k < p.rows.size(); ++k) {
      Row<6>& row = soft_friction.rows[k];
      row.B = once.rows[k].B;
      if (row.hi == infinity) row = once.rows[k];
    }
    sweep(once.rows, once.V);
    sweep(soft_friction.rows, soft_friction.V);
    for (Row<6>& row : from_zero.rows) row.lambda = 0;
    for (Twist<6>& V : from_zero.V) V.setZero();
    from_zero.rows = made_rigid(from_zero);
    sweep(from_zero.rows, from_zero.V);
    const SolveReport report = relax(p.motion, p.rows, p.V, {.max_sweeps = 1, .tolerance = 0});
    expect_near_vector(
        "λ of " + std::to_string(count) + " rows after one sweep [N s]", "Eq. (10.15)", lambdas(p),
        lambdas(once), roundings(1e5 * count, 10),
        {{lambdas(from_zero), "It began with λ = 0: begin with the λ and V of the first solve."},
         {lambdas(soft_friction),
          "Rows that have an upper bound keep their Σ. In friction rows, too, Σ is 0 now."}},
        "Make one sweep of rigid rows, from the present λ and V, within the bounds of the rows. " + ends_early);
    expect_near_vector("V after one sweep [m/s, rad/s]", "Eq. (10.15)", flat(p.V), flat(once.V),
                       roundings(1e5 * count, 10), {},
                       "λ and V belong together: change neither before the sweep.");
    expect_true("its history has one entry", "Eq. (4.9)", report.history.size() == 1,
                "One sweep is allowed: make exactly one.");
  }
}

EXERCISE_TEST(Relax, KeepsTheDigitsOfAVerySoftRow) {
  // S = 0.5/kg beside Σ = 1e16/kg: rounding loses S in their sum.
  Problem<3> p = overlapping_ball(-0.02);
  p.rows[0].Sigma = 1e16;
  p.rows[0].diagonal = 0.5 + 1e16;
  relax(p.motion, p.rows, p.V, {.max_sweeps = 1, .tolerance = 0});
  expect_near("λ [N s] of a row that was very soft, after one sweep", "Eq. (10.15), (4.3)", p.rows[0].lambda,
              0.32, roundings(16), {},
              "Compute Gi·M⁻¹Gi + Gj·M⁻¹Gj anew: the old diagonal less Σ is round-off where Σ is large.");
}

EXERCISE_TEST(Relax, ChangesOnlyTheImpulsesOfTheRows) {
  Random random;
  Problem<6> p = random_problem(random, 4, 6);
  solve(p.rows, p.V, {.max_sweeps = 10, .tolerance = 0});
  const std::vector<Row<6>> before = p.rows;
  relax(p.motion, p.rows, p.V, {.max_sweeps = 3, .tolerance = 0});
  for (std::size_t k = 0; k < before.size(); ++k)
    expect_true("B, Σ, diagonal and bounds of row " + std::to_string(k) + " are unchanged", "Eq. (10.15)",
                p.rows[k].B == before[k].B && p.rows[k].Sigma == before[k].Sigma &&
                    p.rows[k].diagonal == before[k].diagonal && p.rows[k].lo == before[k].lo &&
                    p.rows[k].hi == before[k].hi,
                "The rows belong to the caller: make copies of them rigid, and copy λ back.");
}

EXERCISE_TEST(Relax, StopsByTheRule) {
  const auto by = [](const StopRule& stop) {
    Random random(11);
    Problem<6> p = random_problem(random, 4, 6);
    take_bounds_off(p);  // all contacts may become inactive in one sweep
    return relax(p.motion, p.rows, p.V, stop);
  };
  expect_stops_by_the_rule("Eq. (4.9)", 5, by);
}

EXERCISE_TEST(Relax, RefusesABadRule) {
  Random random;
  Problem<6> p = random_problem(random, 4, 6);
  solve(p.rows, p.V, {.max_sweeps = 10, .tolerance = 0});
  const auto state = [&] {
    std::vector<double> all = state_of(p.rows, p.V)();
    for (const Row<6>& row : p.rows) all.insert(all.end(), {row.B, row.Sigma, row.diagonal});
    return all;
  };
  expect_rejects(
      "relax(max_sweeps = 0), without rows", "max_sweeps",
      [&] {
        std::vector<Row<6>> none;
        relax(p.motion, none, p.V, {.max_sweeps = 0, .tolerance = 0});
      },
      "solve() refuses it, rows or not.", state);
  for (const int sweeps : {0, -1})
    expect_rejects(
        "relax(max_sweeps = " + std::to_string(sweeps) + ")", "max_sweeps",
        [&] { relax(p.motion, p.rows, p.V, {.max_sweeps = sweeps, .tolerance = 0}); },
        "Refuse it as solve() does, before anything is changed.", state);
  for (const double tolerance : {-1e-9, std::nan(""), infinity})
    expect_rejects(
        "relax(tolerance = " + show(tolerance) + ")", "tolerance",
        [&] { relax(p.motion, p.rows, p.V, {.max_sweeps = 5, .tolerance = tolerance}); },
        "Refuse it as solve() does, before anything is changed.", state);
}

}  // namespace
