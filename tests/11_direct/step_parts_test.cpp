// The three parts of an interior-point step: S̃, Newton's step, and its longest part.
#include "algebra.hpp"
#include "exercise_test.hpp"
#include "interior.hpp"
#include "random_input.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(BarrierMatrix, "11.5 barrier_matrix");
EXERCISE(NewtonStep, "11.6 newton_step");
EXERCISE(LongestStep, "11.7 longest_step");

std::string row(Eigen::Index k) {
  return " of row " + std::to_string(k);
}

std::string bounds_of(const Interior& now, Eigen::Index k) {
  const char* names[] = {" (no bound)", " (bound below)", " (bound above)", " (two bounds)"};
  return names[has_lo(now, k) + 2 * has_hi(now, k)];
}

EXERCISE_TEST(BarrierMatrix, StiffensTheDiagonal) {
  Random random;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const int rows = repeat == 0 ? many : 12;
    const Inside p = random_inside(random, rows);
    const Vector got = barrier_matrix(lower_triangle(p.S), p.now).diagonal();
    for (Eigen::Index k = 0; k < rows; ++k) {
      const double S = p.S(k, k), lo = p.now.push_lo[k] / p.now.room_lo[k];
      const double hi = p.now.push_hi[k] / p.now.room_hi[k];
      const double flat_lo = has_lo(p.now, k) ? p.now.push_lo[k] * p.now.room_lo[k] : 0;
      const double flat_hi = has_hi(p.now, k) ? p.now.push_hi[k] * p.now.room_hi[k] : 0;
      expect_near("diagonal" + row(k) + " of " + std::to_string(rows) + bounds_of(p.now, k) + " [1/kg]",
                  "Eq. (11.7)", got[k], S + lo + hi, roundings(10, S + lo + hi),
                  {{S + lo, "The bound above makes it stiffer, too."},
                   {S + hi, "The bound below makes it stiffer, too."},
                   {S + lo - hi, "Both bounds make it stiffer: the push grows towards either."},
                   {S + flat_lo + flat_hi, "Push over room: [m/s]/[N s] is 1/kg."},
                   {lo + hi, "Add it to S."},
                   {S, "This is S alone: add z/s of each bound. " + ends_early}});
    }
  }
}

EXERCISE_TEST(BarrierMatrix, LeavesRowsWithoutBounds) {
  Random random;
  Inside p = random_inside(random, 8);
  p.now.room_lo.setConstant(infinity), p.now.room_hi.setConstant(infinity);
  p.now.push_lo.setZero(), p.now.push_hi.setZero();
  const SparseMatrix S = lower_triangle(p.S);
  const MatrixXd change = MatrixXd(barrier_matrix(S, p.now)) - MatrixXd(S);
  expect_near("|S̃ - S| without any bound", "Eq. (11.7)", change.norm(), 0, {0, "0/∞ is 0"}, {},
              "Only the diagonal changes, and only by bounds: S̃ is a lower triangle, as S is.");
}

EXERCISE_TEST(BarrierMatrix, KeepsThePatternAndTheRest) {
  Random random;
  const Inside p = random_inside(random, 12);
  const SparseMatrix S = lower_triangle(p.S), got = barrier_matrix(S, p.now);
  expect_true("S̃ is compressed", "Eq. (11.7)", got.isCompressed());
  expect_near("entries of S̃", "Eq. (11.7)", static_cast<double>(got.nonZeros()),
              static_cast<double>(S.nonZeros()), {0, "as many as S has"}, {},
              "Keep the pattern of S: otherwise L's pattern is analysed in every step.");
  MatrixXd off = MatrixXd(got) - MatrixXd(S);
  off.diagonal().setZero();
  expect_near("change off the diagonal [1/kg]", "Eq. (11.7)", off.norm(), 0, {0, "exact"}, {},
              "A bound belongs to one row.");
  // Rows that share a body, with G at right angles to each other: an entry that happens to be 0.
  Inside two = random_inside(random, 2);
  SparseMatrix zero(2, 2);
  zero.insert(0, 0) = zero.insert(1, 1) = 1;
  zero.insert(1, 0) = 0;
  zero.makeCompressed();
  expect_near("entries of S̃ when one of the three of S is 0", "Eq. (11.7)",
              static_cast<double>(barrier_matrix(zero, two.now).nonZeros()), 3, {0, "as many as S has"}, {},
              "An entry that is 0 is part of the pattern: without it `factorise` has to analyse it again.");
}

EXERCISE_TEST(BarrierMatrix, AddsPushOverRoomToTheDiagonal) {
  // With s z = τ kept, z = τ/s, and -dz/ds = τ/s² = z/s.
  Interior now{.lambda = Vector::Zero(1),
               .room_lo = Vector::Constant(1, 0.01),
               .room_hi = Vector::Constant(1, infinity),
               .push_lo = Vector::Constant(1, 3),
               .push_hi = Vector::Zero(1)};
  const SparseMatrix S = lower_triangle(MatrixXd::Constant(1, 1, 2));
  expect_near("diagonal of a row 0.01 N s from its bound, with a push of 3 m/s [1/kg]", "Eq. (11.7)",
              barrier_matrix(S, now).coeff(0, 0), 302, roundings(4, 302));
}

// Newton's step with the numbers of `p`, S̃ factorised here.
Interior step_of(const Inside& p) {
  Factors factors;
  factors.ldlt.compute(lower_triangle(dense_barrier(p)));
  return newton_step(lower_triangle(p.S), p.B, p.now, p.target, factors);
}

/// The right-hand side of Eq. (11.8), and likely mistakes in it.
struct Right {
  double S_lambda = -1, lo = 1, hi = -1;  // factors of S λ and of τ/s
  double pushes = 0;                      // factor of z⁻ - z⁺
  bool lower_triangle = false, rooms_swapped = false, undivided = false;
};

VectorXd dense_change(const Inside& p, const Right& right = {}) {
  const MatrixXd S = right.lower_triangle ? MatrixXd(p.S.triangularView<Eigen::Lower>()) : p.S;
  VectorXd lo = p.target.lo, hi = p.target.hi;
  if (!right.undivided) {
    lo = lo.cwiseQuotient(right.rooms_swapped ? p.now.room_hi : p.now.room_lo);
    hi = hi.cwiseQuotient(right.rooms_swapped ? p.now.room_lo : p.now.room_hi);
  }
  return solution_of(dense_barrier(p), p.B + right.S_lambda * S * p.now.lambda + right.lo * lo + right.hi * hi +
                                           right.pushes * (p.now.push_lo - p.now.push_hi));
}

EXERCISE_TEST(NewtonStep, SolvesTheRowsWithTheNewPushes) {
  Random random;
  for (int repeat = 0; repeat < 10 && !::testing::Test::HasFailure(); ++repeat) {
    const int rows = repeat == 9 ? many : 12;
    const Inside p = random_inside(random, rows);
    const Interior step = step_of(p);
    if (!has_size(step, rows, "Eq. (11.9)")) return;
    const VectorXd right = dense_change(p);
    expect_near_vector(
        "Δλ of " + std::to_string(rows) + " rows [N s]", "Eq. (11.8)", VectorXd(step.lambda), right,
        {1e-10 * (1 + right.norm()), "round-off times a condition of 1e3, and some more"},
        {{dense_change(p, {.lower_triangle = true}),
          "S is stored as its lower triangle: the product S λ needs the other half, too."},
         {dense_change(p, {.S_lambda = 0}), "S λ is missing: the residual is B - S λ."},
         {dense_change(p, {.S_lambda = 1}), "The sign of S λ: the residual is B - S λ."},
         {VectorXd(dense_change(p, {.S_lambda = 0}) - p.now.lambda),
          "S λ is missing: subtracting λ from the result takes S̃ λ off, which is more."},
         {dense_change(p, {.lo = 0, .hi = 0}), "τ⁻/s⁻ - τ⁺/s⁺ is missing."},
         {dense_change(p, {.lo = 0}), "τ⁻/s⁻, of the bounds below, is missing."},
         {dense_change(p, {.hi = 0}), "τ⁺/s⁺, of the bounds above, is missing."},
         {dense_change(p, {.hi = 1}), "The sign of τ⁺/s⁺: a bound above pushes λ down."},
         {dense_change(p, {.lo = -1}), "The sign of τ⁻/s⁻: a bound below pushes λ up."},
         {dense_change(p, {.lo = -1, .hi = 1}), "The signs of τ⁻/s⁻ and τ⁺/s⁺."},
         {dense_change(p, {.rooms_swapped = true}), "τ⁻ belongs to the room below, and τ⁺ to the room above."},
         {dense_change(p, {.undivided = true}), "τ is not divided by the room."},
         {dense_change(p, {.lo = 0, .hi = 0, .pushes = 1}),
          "The present pushes z⁻ - z⁺ stand in place of τ⁻/s⁻ - τ⁺/s⁺."},
         {dense_change(p, {.pushes = 1}),
          "The present pushes z⁻ - z⁺ are added. Eq. (11.9) has taken them out of Eq. (11.8)."}},
        "S̃ Δλ = B - S λ + τ⁻/s⁻ - τ⁺/s⁺, with S̃ in `factors`.");
    if (::testing::Test::HasFailure()) return;
    const VectorXd lambda = p.now.lambda + step.lambda;
    const VectorXd lo = p.now.push_lo + step.push_lo, hi = p.now.push_hi + step.push_hi;
    const VectorXd missing = p.B + lo - hi - p.S * lambda;
    for (Eigen::Index k = 0; k < rows && !::testing::Test::HasFailure(); ++k)
      expect_near("B + z⁻ - z⁺ - S λ after the whole step," + row(k) + " of " + std::to_string(rows) +
                      bounds_of(p.now, k) + " [m/s]",
                  "Eq. (11.5)", missing[k], 0, {1e-12, "round-off times stiffnesses up to 20"}, {},
                  "Δλ is right, so Δz⁻ or Δz⁺ is not. The equation is linear: one whole step gets it right. " +
                      (rows == many ? ends_early : ""));
  }
}

EXERCISE_TEST(NewtonStep, MissesTheTargetByItsSecondOrderOnly) {
  Random random;
  for (int repeat = 0; repeat < 10; ++repeat) {
    const Inside p = random_inside(random, 12);
    const Interior step = step_of(p);
    if (!has_size(step, 12, "Eq. (11.9)")) return;
    const auto product_error = [](double room, double push, double target, double dr, double dp) {
      return (room + dr) * (push + dp) - target - dr * dp;
    };
    for (Eigen::Index k = 0; k < 12; ++k) {
      const double change = step.lambda[k];
      for (const bool above : {false, true}) {
        if (!(above ? has_hi(p.now, k) : has_lo(p.now, k))) continue;
        const double s = (above ? p.now.room_hi : p.now.room_lo)[k],
                     z = (above ? p.now.push_hi : p.now.push_lo)[k];
        const double tau = (above ? p.target.hi : p.target.lo)[k], ds = above ? -change : change;
        const double other_tau = (above ? p.target.lo : p.target.hi)[k];
        const double other_z = (above ? p.now.push_lo : p.now.push_hi)[k];
        const std::string room =
            above ? "the room above shrinks as λ grows: Δs is -Δλ." : "the room below grows with λ: Δs is Δλ.";
        expect_near(std::string(above ? "Δz⁺" : "Δz⁻") + row(k) + bounds_of(p.now, k) + " [m/s]", "Eq. (11.9)",
                    (above ? step.push_hi : step.push_lo)[k], (tau - z * ds) / s - z,
                    {1e-12 * (1 + std::abs(tau) + std::abs(z * ds)) / s, "round-off of its terms"},
                    {{(tau - z * ds) / s, "This is the push after the step. Its change is that minus z."},
                     {tau / s - z, "z Δs/s is missing: the push also depends on how far the room changes."},
                     {(tau + z * ds) / s - z, "The sign of z Δs: " + room},
                     {tau / s - z * ds - z, "Divide z Δs by the room, too."},
                     {(tau - z * ds) / (s + ds) - z, "Divide by the room before the step."},
                     {(tau - s * z - z * ds) / s - z, "The present push z is subtracted twice."},
                     {(other_tau - z * ds) / s - z, "This has the target of the row's other bound."},
                     {(tau - other_z * ds) / s - other_z, "This has the push of the row's other bound."},
                     {0, has_lo(p.now, k) && has_hi(p.now, k)
                             ? "It has not changed. A row with two bounds has two pushes that change."
                             : "It has not changed."}},
                    "s Δz + z Δs has to be τ - s z: " + room);
      }
      if (has_lo(p.now, k))
        expect_near(
            "(s + Δs)(z + Δz) - τ - Δs Δz below," + row(k), "Eq. (11.9)",
            product_error(p.now.room_lo[k], p.now.push_lo[k], p.target.lo[k], step.room_lo[k], step.push_lo[k]),
            0, {1e-12, "round-off times 1e2"}, {}, "s Δz + z Δs has to be τ - s z, with Δs = Δλ.");
      if (has_hi(p.now, k))
        expect_near(
            "(s + Δs)(z + Δz) - τ - Δs Δz above," + row(k), "Eq. (11.9)",
            product_error(p.now.room_hi[k], p.now.push_hi[k], p.target.hi[k], step.room_hi[k], step.push_hi[k]),
            0, {1e-12, "round-off times 1e2"}, {},
            "s Δz + z Δs has to be τ - s z, with Δs = -Δλ: the room above shrinks as λ grows.");
    }
  }
}

EXERCISE_TEST(NewtonStep, RoomsFollowTheImpulse) {
  Random random;
  const Inside p = random_inside(random, 12);
  const Interior step = step_of(p);
  if (!has_size(step, 12, "Eq. (11.9)")) return;
  for (Eigen::Index k = 0; k < 12; ++k) {
    const double change = step.lambda[k];
    if (has_lo(p.now, k))
      expect_near("Δs below," + row(k) + " [N s]", "Eq. (11.5)", step.room_lo[k], change, {0, "s = λ - lo"},
                  {{-change, "The room below grows with λ."}});
    if (has_hi(p.now, k))
      expect_near("Δs above," + row(k) + " [N s]", "Eq. (11.5)", step.room_hi[k], -change, {0, "s = hi - λ"},
                  {{change, "The room above shrinks as λ grows."}});
  }
}

EXERCISE_TEST(NewtonStep, LeavesBoundsThatAreNotThere) {
  Random random;
  const Inside p = random_inside(random, 12);
  const Interior step = step_of(p);
  if (!has_size(step, 12, "Eq. (11.9)")) return;
  for (Eigen::Index k = 0; k < 12; ++k) {
    const std::string what = row(k) + bounds_of(p.now, k);
    const std::string clue = "Where there is no bound, room and push do not change.";
    if (!has_lo(p.now, k)) {
      expect_near("Δs below," + what + " [N s]", "Eq. (11.5)", step.room_lo[k], 0, {0, "exact"}, {}, clue);
      expect_near("Δz below," + what + " [m/s]", "Eq. (11.9)", step.push_lo[k], 0, {0, "exact"}, {}, clue);
    }
    if (!has_hi(p.now, k)) {
      expect_near("Δs above," + what + " [N s]", "Eq. (11.5)", step.room_hi[k], 0, {0, "exact"}, {}, clue);
      expect_near("Δz above," + what + " [m/s]", "Eq. (11.9)", step.push_hi[k], 0, {0, "exact"}, {}, clue);
    }
  }
}

EXERCISE_TEST(NewtonStep, IsThatOfAllFiveVectorsAtOnce) {
  Random random;
  const int n = 8;
  Inside p = random_inside(random, n);
  for (Eigen::Index k = 0; k < n; ++k) {  // two bounds for all
    p.now.room_lo[k] = random.uniform(0.1, 2), p.now.room_hi[k] = random.uniform(0.1, 2);
    p.now.push_lo[k] = random.uniform(0.1, 2), p.now.push_hi[k] = random.uniform(0.1, 2);
  }
  // Unknowns Δλ, Δz⁻, Δz⁺; equations: (11.5), then (11.6) of the bounds below and above, each to first order.
  const MatrixXd one = MatrixXd::Identity(n, n);
  MatrixXd A = MatrixXd::Zero(3 * n, 3 * n);
  A.topRows(n) << p.S, -one, one;
  A.middleRows(n, n) << MatrixXd(p.now.push_lo.asDiagonal()), MatrixXd(p.now.room_lo.asDiagonal()),
      MatrixXd::Zero(n, n);
  A.bottomRows(n) << -MatrixXd(p.now.push_hi.asDiagonal()), MatrixXd::Zero(n, n),
      MatrixXd(p.now.room_hi.asDiagonal());
  VectorXd right(3 * n);
  right << p.B + p.now.push_lo - p.now.push_hi - p.S * p.now.lambda,
      p.target.lo - p.now.room_lo.cwiseProduct(p.now.push_lo),
      p.target.hi - p.now.room_hi.cwiseProduct(p.now.push_hi);
  const VectorXd expected = solution_of(A, right);
  const Interior step = step_of(p);
  if (!has_size(step, n, "Eq. (11.9)")) return;
  const Tolerance tolerance{1e-10 * (1 + expected.norm()), "round-off times a condition of 1e3, and some more"};
  expect_near_vector("Δλ [N s]", "Eq. (11.8)", VectorXd(step.lambda), VectorXd(expected.head(n)), tolerance, {},
                     "τ/s is z + Δz without the effect of Δλ, which is in S̃ already.");
  expect_near_vector("Δz⁻ [m/s]", "Eq. (11.9)", VectorXd(step.push_lo), VectorXd(expected.segment(n, n)),
                     tolerance);
  expect_near_vector("Δz⁺ [m/s]", "Eq. (11.9)", VectorXd(step.push_hi), VectorXd(expected.tail(n)), tolerance);
}

EXERCISE_TEST(NewtonStep, IsZeroAtTheSolution) {
  Random random;
  Inside p = random_inside(random, 12);
  p.B = p.S * p.now.lambda - p.now.push_lo + p.now.push_hi;
  for (Eigen::Index k = 0; k < 12; ++k) {
    if (has_lo(p.now, k)) p.target.lo[k] = p.now.room_lo[k] * p.now.push_lo[k];
    if (has_hi(p.now, k)) p.target.hi[k] = p.now.room_hi[k] * p.now.push_hi[k];
  }
  const Interior step = step_of(p);
  if (!has_size(step, 12, "Eq. (11.9)")) return;
  const Tolerance tolerance{1e-12, "round-off times stiffnesses up to 20"};
  const std::string clue = "The residual is 0 and s z has its target: the step is 0.";
  expect_near("|Δλ| [N s]", "Eq. (11.8)", step.lambda.norm(), 0, tolerance, {}, clue);
  expect_near("|Δz⁻| [m/s]", "Eq. (11.9)", step.push_lo.norm(), 0, tolerance, {}, clue);
  expect_near("|Δz⁺| [m/s]", "Eq. (11.9)", step.push_hi.norm(), 0, tolerance, {}, clue);
}

// Vectors of four rows: room and push 1 on both sides, and no change.
Interior four(double value) {
  const Vector all = Vector::Constant(4, value);
  return {.lambda = all, .room_lo = all, .room_hi = all, .push_lo = all, .push_hi = all};
}

EXERCISE_TEST(LongestStep, IsWholeWhereNothingShrinks) {
  expect_near("the part of a step that changes nothing", "Eq. (11.10)", longest_step(four(1), four(0)), 1,
              {0, "exact"}, {}, "Nothing limits it, so all of it is taken: the part is at most 1.");
  expect_near("the part of a step in which all values grow", "Eq. (11.10)", longest_step(four(1), four(5)), 1,
              {0, "exact"}, {{0.2, "An increase is no limit: only a negative change is."}});
  Interior step = four(0);
  step.lambda.setConstant(-5);
  expect_near("the part of a step in which λ alone shrinks", "Eq. (11.10)", longest_step(four(1), step), 1,
              {0, "exact"}, {{0.2, "λ may have any sign: keep its rooms positive."}});
}

EXERCISE_TEST(LongestStep, EndsAtTheFirstBound) {
  const VectorXd one = VectorXd::Ones(many), none = VectorXd::Zero(many);
  const Interior start{.lambda = one, .room_lo = one, .room_hi = one, .push_lo = one, .push_hi = one};
  for (const Part& part : parts) {
    Interior step{.lambda = none, .room_lo = none, .room_hi = none, .push_lo = none, .push_hi = none};
    (step.*part.vector)[many - 1] = -4;
    expect_near("the part of a step in which the " + std::string(part.name) + " of the last of " +
                    std::to_string(many) + " rows goes from 1 to -3",
                "Eq. (11.10)", longest_step(start, step), 0.25, roundings(4),
                {{1, "Is this one no limit? A loop that ends early misses it."}});
  }
  for (const Part& part : parts)
    for (Eigen::Index k = 0; k < 4; ++k) {
      Interior now = four(1), step = four(0);
      (now.*part.vector)[k] = 0.3;
      (step.*part.vector)[k] = -0.4;
      (step.*part.vector)[(k + 1) % 4] = -1.1;  // 1/1.1 is later
      expect_near("the part of a step in which the " + std::string(part.name) + row(k) +
                      " goes from 0.3 to -0.1, and the next from 1 to -0.1",
                  "Eq. (11.10)", longest_step(now, step), 0.75, roundings(4),
                  {{1, "Is this one no limit? Four vectors have to stay >= 0: two rooms, two pushes."},
                   {1 / 1.1, "The first to reach 0 counts, not the last."}},
                  "0.3 - share 0.4 = 0.");
    }
}

// At a solution some rooms are 1e-12 of others, and the last steps change these.
EXERCISE_TEST(LongestStep, IncludesVerySmallEntries) {
  for (const double part : relative_scales)
    for (const Part& of : parts) {
      Interior now = four(1), step = four(0);
      (now.*of.vector)[1] = part;
      (step.*of.vector)[1] = -4 * part;
      expect_near("the part of a step in which the " + std::string(of.name) + row(1) + " falls from " +
                      show(part) + " to -3 times that, beside others of 1",
                  "Eq. (11.10)", longest_step(now, step), 0.25, roundings(4),
                  {{1, "Is it no limit? " + small_is_dropped}}, small_is_dropped);
      (step.*of.vector)[1] = -1;
      expect_near("the part of a step in which the " + std::string(of.name) + row(1) + " falls from " +
                      show(part) + " by 1",
                  "Eq. (11.10)", longest_step(now, step), part, roundings(4, part),
                  {{0, "Its change was treated as 0. " + small_is_dropped}}, small_is_dropped);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(LongestStep, IsNeverMoreThanWhole) {
  for (const Part& part : parts) {
    Interior step = four(0);
    (step.*part.vector)[2] = -0.01;
    expect_near("the part of a step in which the " + std::string(part.name) + " goes from 1 to 0.99",
                "Eq. (11.10)", longest_step(four(1), step), 1, {0, "exact"},
                {{100, "A whole step is Newton's: the part is at most 1."}});
    (step.*part.vector)[2] = -1;
    expect_near("the part of a step in which the " + std::string(part.name) + " goes from 1 to 0",
                "Eq. (11.10)", longest_step(four(1), step), 1, {0, "exact"}, {},
                "The part may lead to 0, but not below; interior_solve keeps a distance by itself.");
  }
}

EXERCISE_TEST(LongestStep, IsZeroFromABoundOutwards) {
  Interior now = four(1), step = four(0);
  now.push_hi[1] = 0;
  step.push_hi[1] = -2;
  expect_near("the part of a step that takes a push from 0 to -2", "Eq. (11.10)", longest_step(now, step), 0,
              {0, "exact"},
              {{1, "A value of 0 that falls leaves no part of the step: 0/2 is a limit like any other."}},
              "No part of the step is left.");
}

EXERCISE_TEST(LongestStep, IgnoresBoundsThatAreNotThere) {
  Interior now = four(1), step = four(0);
  now.room_lo.setConstant(infinity), now.push_lo.setZero();
  now.room_hi[0] = infinity, now.push_hi[0] = 0;
  step.room_hi[3] = -4;
  expect_near(
      "the part of a step with rows that have no bound", "Eq. (11.10)", longest_step(now, step), 0.25,
      {0, "exact"},
      {{1, "The row with a bound was left out: where one of two bounds is missing, the other still counts."},
       {0, "A push of 0 that does not change is no limit: there is no bound."}},
      "An infinite room is no limit, and neither is a push that stays 0.");
}

EXERCISE_TEST(LongestStep, KeepsAllAndCannotBeLonger) {
  Random random;
  for (int repeat = 0; repeat < 50; ++repeat) {
    Interior now = four(1), step = four(0);
    for (const Part& part : parts)
      for (Eigen::Index k = 0; k < 4; ++k) {
        (now.*part.vector)[k] = random.log_uniform(1e-6, 1e3);
        (step.*part.vector)[k] = random.uniform(-1, 1);
      }
    const double share = longest_step(now, step);
    double least = infinity, a_little_more = infinity;
    for (const Part& part : parts) {
      const Vector &value = now.*part.vector, &change = step.*part.vector;
      least = std::min(least, ((value + share * change).array() / value.array()).minCoeff());
      a_little_more = std::min(a_little_more, (value + (share + 1e-9) * change).minCoeff());
    }
    expect_at_least("least of rooms and pushes after that part, over what it was", "Eq. (11.10)", least, -1e-9,
                    "0, and round-off of a change 1e6 times as large",
                    "A value goes below 0: all rows of all four vectors are limits. Take the smallest "
                    "-value/change of those that fall.");
    if (share < 1)
      expect_at_most("least of rooms and pushes after a part that is 1e-9 longer", "Eq. (11.10)", a_little_more,
                     0, "one would be negative", "It could have been longer.");
    expect_at_most("the part", "Eq. (11.10)", share, 1, "a whole step",
                   "The part is at most 1, also where nothing limits it.");
  }
}

EXERCISE_TEST(BarrierMatrix, DropsNothingSmall) {
  for (const double part : relative_scales) {
    Interior now = four(1);
    now.push_lo.setConstant(part), now.push_hi.setConstant(part);
    const SparseMatrix S = lower_triangle(MatrixXd::Identity(4, 4));
    expect_near("what bounds with a push of " + show(part) + " m/s add to the diagonal [1/kg]", "Eq. (11.7)",
                barrier_matrix(S, now).coeff(2, 2) - 1, 2 * part, roundings(4),
                {{0, "They add nothing. " + small_is_dropped}}, small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(NewtonStep, DropsNothingSmall) {
  // One row, λ between two bounds. Of the four terms in its equation one is large, and another small.
  const VectorXd one = VectorXd::Ones(1);
  const std::string names[] = {"B", "S λ", "τ⁻/s⁻", "τ⁺/s⁺"};
  for (const double part : relative_scales)
    for (int large = 0; large < 4; ++large)
      for (int more = 1; more < 4; ++more) {
        const int small = (large + more) % 4;
        double term[4] = {0, 0, 0, 0};
        term[large] = 1, term[small] = part;
        const Inside p{
            .S = MatrixXd::Identity(1, 1),
            .B = term[0] * one,
            .now = {.lambda = term[1] * one, .room_lo = one, .room_hi = one, .push_lo = one, .push_hi = one},
            .target = {.lo = term[2] * one, .hi = term[3] * one}};
        Factors factors;
        factorise(lower_triangle(dense_barrier(p)), factors);
        const Interior step = newton_step(lower_triangle(p.S), p.B, p.now, p.target, factors);
        if (!has_size(step, 1, "Eq. (11.8)")) return;
        expect_near(
            "Δλ, where " + names[large] + " = 1 m/s and " + names[small] + " = " + show(part) + " m/s [N s]",
            "Eq. (11.8)", step.lambda[0], (term[0] - term[1] + term[2] - term[3]) / 3, roundings(4), {},
            small_is_dropped);
        if (::testing::Test::HasFailure()) return;
      }
}

}  // namespace
