// Beyond chapter 11's own tests: one system, by every function of the chapter, against dense elimination and properties.
#include "11_direct/direct.hpp"
#include "algebra.hpp"
#include "dense_rows.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SchurComplement, "11.1 schur_complement");
EXERCISE(SaddleMatrix, "11.2 saddle_matrix");
EXERCISE(Factorise, "11.3 factorise");
EXERCISE(SaddleSolve, "11.4 saddle_solve");
EXERCISE(BarrierMatrix, "11.5 barrier_matrix");
EXERCISE(NewtonStep, "11.6 newton_step");
EXERCISE(LongestStep, "11.7 longest_step");
EXERCISE(InteriorStart, "11.8 interior_start");
EXERCISE(InteriorStep, "11.9 interior_step");
EXERCISE(InteriorSolve, "11.10 interior_solve");
EXERCISE(DirectSolve, "11.11 direct_solve");

struct Wired {
  Random random;
  Motion<6> motion;
  std::vector<Row<6>> rows;
  std::vector<Twist<6>> V;

  explicit Wired(bool bounded, int count = 14) {
    for (int k = 0; k < 8; ++k) {
      motion.inverse_mass.push_back(random_body(random));
      motion.W.push_back(random.twist());
      motion.Wf.push_back(random.twist(0.2));
    }
    for (int k = 0; k < count; ++k) {
      const int i = k % 7;  // a wire, and cross links
      const Twist<6> Gi = random.twist(), Gj = random.twist();
      rows.push_back(make_row<6>({.i = i,
                                  .j = k < 7 ? i + 1 : (i + 3) % 8,
                                  .Gi = Gi,
                                  .Gj = Gj,
                                  .gap = random.uniform(-0.1, 0.1),
                                  .spook = {.a = 4, .b = 0.8, .Sigma = 0.1},
                                  .lo = bounded && k % 2 == 0 ? 0 : -infinity,
                                  .hi = bounded && k % 3 == 0 ? 0.2 : infinity},
                                 motion));
    }
    V.assign(8, Twist<6>::Zero());
  }

  Eigen::VectorXd eliminated() const { return solution_of(dense_S(rows), gathered(rows, &Row<6>::B)); }
};

EXERCISE_TEST(SchurComplement, IsTheMatrixOfAnyScene) {
  const Wired t(false);
  const SparseMatrix S = schur_complement(t.rows);
  const Eigen::MatrixXd lower = Eigen::MatrixXd(S).triangularView<Eigen::Lower>();
  const Eigen::MatrixXd expected = dense_S(t.rows).triangularView<Eigen::Lower>();
  expect_near("largest difference on and below the diagonal [1/kg]", "Eq. (11.1)",
              (lower - expected).cwiseAbs().maxCoeff(), 0, roundings(200, expected.cwiseAbs().maxCoeff()));
}

EXERCISE_TEST(Factorise, SolvesWhatItWasGiven) {
  const Wired t(false);
  const Eigen::MatrixXd dense = dense_S(t.rows);
  const Eigen::MatrixXd lower = dense.triangularView<Eigen::Lower>();
  Factors factors;
  expect_true("S with Σ = 0.1 can be factorised", "Eq. (11.4)", factorise(lower.sparseView(), factors));
  const Eigen::MatrixXd nothing = Eigen::MatrixXd::Ones(2, 2).triangularView<Eigen::Lower>();
  Factors of_nothing;
  expect_true("two rows that say the same, with Σ = 0, cannot", "Eq. (11.4)",
              !factorise(nothing.sparseView(), of_nothing));
}

EXERCISE_TEST(SaddleSolve, AgreesWithElimination) {
  Wired t(false);
  const Eigen::VectorXd expected = t.eliminated();
  const double condition = dense_S(t.rows).norm() / 0.1;  // no eigenvalue is below Σ
  Factors factors;
  expect_true("it is solved", "Eq. (11.2)", saddle_solve(t.rows, t.motion.inverse_mass, t.V, factors));
  expect_near_vector("λ [N s]", "Eq. (11.2)", gathered(t.rows, &Row<6>::lambda), expected,
                     roundings(100 * condition, 1 + expected.norm()));
}

EXERCISE_TEST(DirectSolve, EndsAtASolutionWithinBounds) {
  Wired t(true);
  Factors factors;
  direct_solve(t.rows, t.V, {.max_sweeps = 100, .tolerance = 0}, factors);
  for (const Row<6>& row : t.rows)
    expect_true("λ is within its bounds", "Eq. (4.1)", row.lambda >= row.lo && row.lambda <= row.hi);
  expect_at_most("residual [m/s]", "Eq. (11.13)", residual(t.rows, t.V), 1e-11,
                 "a hundred times (11.13) for B of 1 m/s");
}

EXERCISE_TEST(SchurComplement, CountsEachShareOfABodyOnce) {
  Wired t(false);
  t.rows[3].i = t.rows[2].i,
  t.rows[3].j = t.rows[2].j;  // two rows of the same two bodies, and one the other way round
  t.rows[4].i = t.rows[2].j, t.rows[4].j = t.rows[2].i;
  for (Row<6>& row : t.rows)
    if (row.i == 0)
      row.MinvGi.setZero();  // body 0 is static
    else if (row.j == 0)
      row.MinvGj.setZero();
  const Eigen::MatrixXd expected = dense_S(t.rows).triangularView<Eigen::Lower>();
  const SparseMatrix S = schur_complement(t.rows);
  expect_true("S has a row and a column for each row", "Eq. (11.1)", S.rows() == 14 && S.cols() == 14);
  if (S.rows() != 14 || S.cols() != 14) return;
  expect_near("largest difference on and below the diagonal [1/kg]", "Eq. (11.1)",
              (Eigen::MatrixXd(S) - expected).cwiseAbs().maxCoeff(), 0,
              roundings(200, expected.cwiseAbs().maxCoeff()));
}

EXERCISE_TEST(SaddleMatrix, HasMassesJacobiansAndSofteners) {
  Wired t(false);
  t.motion.inverse_mass[3] = {};  // static
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(48 + 14, 48 + 14);
  for (int b = 0; b < 8; ++b) {
    const InverseMass<6>& inverse = t.motion.inverse_mass[static_cast<std::size_t>(b)];
    expected.block<6, 6>(6 * b, 6 * b).setIdentity();
    if (b == 3) continue;
    expected.block<3, 3>(6 * b, 6 * b) /= inverse.linear;
    expected.block<3, 3>(6 * b + 3, 6 * b + 3) = inverse.angular.inverse();
  }
  for (int k = 0; k < 14; ++k) {
    const Row<6>& row = t.rows[static_cast<std::size_t>(k)];
    if (row.i != 3) expected.block<1, 6>(48 + k, 6 * row.i) = row.Gi.transpose();
    if (row.j != 3) expected.block<1, 6>(48 + k, 6 * row.j) = row.Gj.transpose();
    expected(48 + k, 48 + k) = -row.Sigma;
  }
  const SparseMatrix A = saddle_matrix(t.rows, t.motion.inverse_mass);
  expect_true("its size is six for each body, and one for each row", "Eq. (11.2)",
              A.rows() == 62 && A.cols() == 62);
  if (A.rows() != 62 || A.cols() != 62) return;
  const Eigen::MatrixXd lower = expected.triangularView<Eigen::Lower>();
  expect_near("largest difference on and below the diagonal", "Eq. (11.2)",
              (Eigen::MatrixXd(A) - lower).cwiseAbs().maxCoeff(), 0,
              roundings(2000, lower.cwiseAbs().maxCoeff()));
}

EXERCISE_TEST(Factorise, SolvesAndAnalysesOnceAPattern) {
  Wired t(false);
  Factors factors;
  for (const double size : {1.0, 1e-9, 1e9}) {
    const SparseMatrix S = size * schur_complement(t.rows);
    expect_true("it can be factorised", "Eq. (11.4)", factorise(S, factors));
    const Eigen::VectorXd expected = Eigen::VectorXd::LinSpaced(14, -1, 1);
    const Eigen::VectorXd right = S.selfadjointView<Eigen::Lower>() * expected;
    expect_near_vector("x of S x = b", "Eq. (11.3)", Eigen::VectorXd(factors.ldlt.solve(right)), expected,
                       {1e-10, "round-off by the condition, a few hundred"});
  }
  expect_true("one analysis is enough for one pattern", "Eq. (11.3)", factors.analyses == 1);
  t.rows.pop_back();
  expect_true("another pattern can be factorised", "Eq. (11.4)",
              factorise(schur_complement(t.rows), factors) && factors.analyses == 2);
  t.rows[2].Sigma = std::nan("");
  expect_true("a NaN cannot", "Eq. (11.4)", !factorise(schur_complement(t.rows), factors));
}

EXERCISE_TEST(SaddleSolve, GivesVelocitiesToo) {
  Wired t(false);
  Factors factors;
  for (Twist<6>& velocity : t.V) velocity = t.random.twist();  // of an earlier solve, to be forgotten
  for (Row<6>& row : t.rows) row.lo = 0, row.hi = 1e-3;        // bounds are for other functions
  const Eigen::VectorXd lambda = t.eliminated();
  saddle_solve(t.rows, t.motion.inverse_mass, t.V, factors);
  expect_near_vector("λ [N s]", "Eq. (11.2)", gathered(t.rows, &Row<6>::lambda), lambda,
                     {1e-10 * (1 + lambda.norm()), "round-off by the condition, a few hundred"});
  std::vector<Twist<6>> expected(8, Twist<6>::Zero());
  for (const Row<6>& row : t.rows) apply_impulse(row, row.lambda, expected);
  for (std::size_t b = 0; b < 8; ++b)
    expect_near_vector("V of body " + std::to_string(b), "Eq. (11.2)", t.V[b], expected[b],
                       {1e-10, "round-off by the condition, a few hundred"});
  std::vector<Row<6>> twice = {t.rows[0], t.rows[0]};
  for (Row<6>& row : twice) row.Sigma = 0;
  expect_true("two equal rows without Σ are refused", "Eq. (11.4)",
              !saddle_solve(twice, t.motion.inverse_mass, t.V, factors));
}

EXERCISE_TEST(Factorise, JudgesEachPivotByItsOwnTerms) {
  for (const double size : {1.0, 1e-20, 1e20}) {
    SparseMatrix A(3, 3), singular(2, 2), open(2, 2);
    const std::vector<Eigen::Triplet<double>> apart = {
        {0, 0, size}, {1, 1, 1e-9 * size}, {2, 2, -1e-18 * size}};
    A.setFromTriplets(apart.begin(), apart.end());
    Factors factors, others, of_open;
    expect_true("pivots of any size and sign are sound where nothing cancels", "Eq. (11.4)",
                factorise(A, factors));
    // The last pivot is that of round-off: where one before it is 0, Eigen leaves the rest of its factors undefined.
    const std::vector<Eigen::Triplet<double>> alike = {{0, 0, size}, {1, 0, size / 3}, {1, 1, size / 9}};
    singular.setFromTriplets(alike.begin(), alike.end());
    expect_true("a pivot that is round-off of its terms is not", "Eq. (11.4)", !factorise(singular, others));
    const std::vector<Eigen::Triplet<double>> none = {{0, 0, size}, {1, 1, 0}};
    open.setFromTriplets(none.begin(), none.end());
    expect_true("nor is a pivot of 0", "Eq. (11.4)", !factorise(open, of_open));
  }
}

EXERCISE_TEST(Factorise, LooksAtThePatternAndNotAtTheSizeAlone) {
  SparseMatrix one(3, 3), other(3, 3);
  const std::vector<Eigen::Triplet<double>> first = {{0, 0, 2.0}, {1, 1, 2.0}, {2, 2, 2.0}, {2, 0, 1.0}};
  const std::vector<Eigen::Triplet<double>> second = {{0, 0, 2.0}, {1, 1, 2.0}, {2, 2, 2.0}, {1, 0, 1.0}};
  one.setFromTriplets(first.begin(), first.end());
  other.setFromTriplets(second.begin(), second.end());
  Factors factors;
  for (const SparseMatrix* A : {&one, &other, &other, &one}) {
    expect_true("it can be factorised", "Eq. (11.4)", factorise(*A, factors));
    const Eigen::Vector3d x(1, 2, 3), right = A->selfadjointView<Eigen::Lower>() * x;
    expect_near_vector("x of A x = b", "Eq. (11.3)", Eigen::Vector3d(factors.ldlt.solve(right)), x,
                       roundings(64, 10));
  }
  expect_true("each change of the pattern is analysed", "Eq. (11.3)", factors.analyses == 3);
}

/// A point between the bounds; some rows have none.
struct Between {
  Random random;
  SparseMatrix S;
  Vector B, lo, hi;
  Interior now;

  Between() {
    Wired t(false, many);
    S = schur_complement(t.rows);
    B = gathered(t.rows, &Row<6>::B);
    lo = hi = now.lambda = now.push_lo = now.push_hi = Vector::Zero(many);
    for (int k = 0; k < many; ++k) {
      now.lambda[k] = random.uniform(-1, 1);
      lo[k] = k % 3 == 0 ? -infinity : now.lambda[k] - random.log_uniform(1e-3, 1);
      hi[k] = k % 4 == 0 ? infinity : now.lambda[k] + random.log_uniform(1e-3, 1);
      now.push_lo[k] = k % 3 == 0 ? 0 : random.log_uniform(1e-3, 1);
      now.push_hi[k] = k % 4 == 0 ? 0 : random.log_uniform(1e-3, 1);
    }
    now.room_lo = now.lambda - lo;
    now.room_hi = hi - now.lambda;
  }
};

EXERCISE_TEST(BarrierMatrix, AddsPushOverRoom) {
  const Between at;
  Eigen::MatrixXd expected = at.S;
  for (int k = 0; k < many; ++k)
    expected(k, k) += at.now.push_lo[k] / at.now.room_lo[k] + at.now.push_hi[k] / at.now.room_hi[k];
  const Eigen::MatrixXd got = barrier_matrix(at.S, at.now);
  expect_near("largest difference [1/kg]", "Eq. (11.7)", (got - expected).cwiseAbs().maxCoeff(), 0,
              roundings(16, expected.cwiseAbs().maxCoeff()));
}

/// Expects the linear equations that a Newton step solves.
void expect_newton(const Between& at, const Interior& step, const Target& target) {
  const Vector velocity = at.S.selfadjointView<Eigen::Lower>() * (at.now.lambda + step.lambda);
  const Vector push = at.now.push_lo + step.push_lo - at.now.push_hi - step.push_hi;
  expect_near_vector<Vector>("S λ - z⁻ + z⁺ - B after the step [m/s]", "Eq. (11.6)",
                             Vector(velocity - push - at.B), Vector(Vector::Zero(many)),
                             {1e-8, "round-off by the condition, a million at most"});
  for (int k = 0; k < many; ++k) {
    const auto side = [&](const std::string& name, double sign, double room, double change, double z, double dz,
                          double tau) {
      if (!std::isfinite(room))
        return expect_near("change of " + name + " without a bound", "Eq. (11.9)",
                           std::abs(change) + std::abs(dz), 0, {0, "it stays"});
      expect_near("change of the room of " + name + " [N s]", "Eq. (11.9)", change, sign * step.lambda[k],
                  roundings(8, step.lambda[k]));
      expect_near("s z + s Δz + z Δs - τ of " + name, "Eq. (11.9)", room * z + room * dz + z * change - tau, 0,
                  {1e-9, "round-off of numbers up to 1000"});
    };
    side("lo", 1, at.now.room_lo[k], step.room_lo[k], at.now.push_lo[k], step.push_lo[k], target.lo[k]);
    side("hi", -1, at.now.room_hi[k], step.room_hi[k], at.now.push_hi[k], step.push_hi[k], target.hi[k]);
  }
}

EXERCISE_TEST(NewtonStep, SolvesItsLinearEquations) {
  Between at;
  Factors factors;
  factorise(barrier_matrix(at.S, at.now), factors);
  Target target{.lo = Vector::Zero(many), .hi = Vector::Zero(many)};
  for (int k = 0; k < many; ++k)
    target.lo[k] = at.random.uniform(0, 0.1), target.hi[k] = at.random.uniform(0, 0.1);
  expect_newton(at, newton_step(at.S, at.B, at.now, target, factors), target);
}

EXERCISE_TEST(LongestStep, IsTheFirstToReachZero) {
  Random random;
  for (int n = 0; n < 40; ++n) {
    Interior now, step;
    double longest = 1;
    for (Vector Interior::*part :
         {&Interior::room_lo, &Interior::room_hi, &Interior::push_lo, &Interior::push_hi}) {
      (now.*part).resize(many), (step.*part).resize(many);
      for (int k = 0; k < many; ++k) {
        (now.*part)[k] = k == n ? infinity : random.log_uniform(0.1, 10);
        (step.*part)[k] = k == n ? 0 : random.uniform(-1, 1) * (n % 4 == 0 ? 0.05 : 2);
        if ((step.*part)[k] < 0) longest = std::min(longest, (now.*part)[k] / -(step.*part)[k]);
      }
    }
    now.lambda = step.lambda = Vector::Constant(many, -100);  // has a sign of its own
    expect_near("longest fraction of the step", "Eq. (11.10)", longest_step(now, step), longest, roundings(8));
  }
}

EXERCISE_TEST(InteriorStart, HasEqualProductsInside) {
  for (const bool still : {false, true}) {
    Between at;
    Vector guess = Vector::Zero(many);
    for (int k = 0; k < many; ++k) guess[k] = at.random.uniform(-2, 2);
    if (still) {
      at.B.setZero(), guess.setZero();
      at.lo = at.lo.cwiseMin(0), at.hi = at.hi.cwiseMax(0);
    }
    double energy = 0;
    for (int k = 0; k < many; ++k) {
      const double S_kk = at.S.coeff(k, k), least = std::max(at.lo[k], std::min(at.hi[k], 0.0)),
                   likely = std::max(at.lo[k], std::min(at.hi[k], guess[k]));
      energy = std::max(energy, at.B[k] * at.B[k] / S_kk + S_kk * (least * least + likely * likely));
    }
    if (still) energy = 1;
    const Interior start = interior_start(at.S, at.B, at.lo, at.hi, guess);
    for (int k = 0; k < many; ++k) {
      const double room = std::min(std::sqrt(energy / at.S.coeff(k, k)), (at.hi[k] - at.lo[k]) / 2);
      const bool below = std::isfinite(at.lo[k]), above = std::isfinite(at.hi[k]);
      const double lambda = std::max(at.lo[k] + room, std::min(0.0, at.hi[k] - room));
      expect_near("λ of row " + std::to_string(k) + " [N s]", "Eq. (11.12)", start.lambda[k], lambda,
                  roundings(64, 5));
      for (const auto& [room_of, push_of, is_there] : {std::tuple(start.room_lo[k], start.push_lo[k], below),
                                                       std::tuple(start.room_hi[k], start.push_hi[k], above)})
        if (is_there)
          expect_near("s z over E", "Eq. (11.12)", room_of * push_of / energy, 1, roundings(64));
        else
          expect_true("without a bound s is infinite and z is 0", "Eq. (11.12)",
                      std::isinf(room_of) && push_of == 0);
    }
  }
}

EXERCISE_TEST(InteriorStep, TakesTwoNewtonSteps) {
  const Between at;
  Factors factors;
  factorise(barrier_matrix(at.S, at.now), factors);
  const Target none{.lo = Vector::Zero(many), .hi = Vector::Zero(many)};
  const Interior straight = newton_step(at.S, at.B, at.now, none, factors);
  const double far = longest_step(at.now, straight);
  const auto mean = [&](double share) {
    double sum = 0;
    int bounds = 0;
    for (int k = 0; k < many; ++k) {
      if (std::isfinite(at.lo[k]))
        sum += (at.now.room_lo[k] + share * straight.room_lo[k]) *
               (at.now.push_lo[k] + share * straight.push_lo[k]),
            ++bounds;
      if (std::isfinite(at.hi[k]))
        sum += (at.now.room_hi[k] + share * straight.room_hi[k]) *
               (at.now.push_hi[k] + share * straight.push_hi[k]),
            ++bounds;
    }
    return sum / bounds;
  };
  const double centre = std::pow(mean(far) / mean(0), 3) * mean(0);
  Target target = none;
  for (int k = 0; k < many; ++k) {
    target.lo[k] = centre - straight.room_lo[k] * straight.push_lo[k];
    target.hi[k] = centre - straight.room_hi[k] * straight.push_hi[k];
  }
  const Interior step = newton_step(at.S, at.B, at.now, target, factors);
  const double longest = longest_step(at.now, step), share = longest < 1 ? (0.9 + 0.0999 * far) * longest : 1;
  const Interior got = interior_step(at.S, at.B, at.lo, at.hi, at.now, factors);
  expect_near_vector<Vector>("λ [N s]", "Eq. (11.11)", got.lambda, Vector(at.now.lambda + share * step.lambda),
                             {1e-8, "round-off by the condition"});
  expect_near_vector<Vector>("z⁻ [m/s]", "Eq. (11.11)", got.push_lo,
                             Vector(at.now.push_lo + share * step.push_lo),
                             {1e-8, "round-off by the condition"});
  expect_near_vector<Vector>("z⁺ [m/s]", "Eq. (11.11)", got.push_hi,
                             Vector(at.now.push_hi + share * step.push_hi),
                             {1e-8, "round-off by the condition"});
  for (int k = 0; k < many; ++k) {
    if (std::isfinite(at.lo[k]))
      expect_near("s⁻ is λ - lo [N s]", "Eq. (11.5)", got.room_lo[k], got.lambda[k] - at.lo[k],
                  roundings(16, 2));
    if (std::isfinite(at.hi[k]))
      expect_near("s⁺ is hi - λ [N s]", "Eq. (11.5)", got.room_hi[k], at.hi[k] - got.lambda[k],
                  roundings(16, 2));
  }
}

/// Eight rows with bounds of every kind.
struct Eight : Wired {
  Eight() : Wired(false) {
    rows.resize(8);
    for (Row<6>& row : rows) give_any_bounds(random, row);
  }
};

EXERCISE_TEST(InteriorSolve, AgreesWithEveryActiveSetTried) {
  Eight t;
  for (Row<6>& row : t.rows)
    if (!(row.lo < row.hi)) row.lo = -infinity;
  const Bounded problem = bounded(t.rows);
  Vector lambda = Vector::Zero(8);
  Factors factors;
  const SparseMatrix S = schur_complement(t.rows);
  const SolveReport report =
      interior_solve(S, problem.B, problem.lo, problem.hi, {.max_sweeps = 60, .tolerance = 0}, lambda, factors);
  expect_true("it converges, and the history has an entry for each factorisation", "Eq. (11.13)",
              report.converged && !report.history.empty());
  expect_near_vector<Vector>("λ [N s]", "Eq. (4.1)", lambda, Vector(enumerate_solution(problem)),
                             {1e-9, "(11.13), by the condition of eight rows"});
  Vector other = Vector::Zero(8);
  const SolveReport early =
      interior_solve(S, problem.B, problem.lo, problem.hi, {.max_sweeps = 1, .tolerance = 0}, other, factors);
  expect_true("after one factorisation it says that it has not converged, and why", "Eq. (11.13)",
              !early.converged && early.history.size() == 1 && !early.trouble.empty());
  expect_rejects("max_sweeps = 0", "max_sweeps", [&] {
    interior_solve(S, problem.B, problem.lo, problem.hi, {.max_sweeps = 0}, other, factors);
  });
  expect_rejects("tolerance = -1", "tolerance", [&] {
    interior_solve(S, problem.B, problem.lo, problem.hi, {.tolerance = -1}, other, factors);
  });
}

EXERCISE_TEST(DirectSolve, AgreesWithEveryActiveSetTried) {
  Eight t;
  for (Twist<6>& velocity : t.V) velocity = t.random.twist();  // of an earlier solve, to be forgotten
  const Eigen::VectorXd expected = enumerate_solution(bounded(t.rows));
  Factors factors;
  const SolveReport report = direct_solve(t.rows, t.V, {.max_sweeps = 60, .tolerance = 0}, factors);
  expect_true("it converges", "Eq. (11.13)", report.converged);
  expect_near_vector("λ [N s]", "Eq. (4.1)", gathered(t.rows, &Row<6>::lambda), expected,
                     {1e-9, "(11.13), by the condition of eight rows"});
  std::vector<Twist<6>> V(8, Twist<6>::Zero());
  for (const Row<6>& row : t.rows) apply_impulse(row, row.lambda, V);
  for (std::size_t b = 0; b < 8; ++b)
    expect_near_vector("V of body " + std::to_string(b), "Eq. (4.5)", t.V[b], V[b], {1e-11, "round-off"});
  expect_rejects("max_sweeps = 0", "max_sweeps",
                 [&] { direct_solve(t.rows, t.V, {.max_sweeps = 0}, factors); });
  expect_rejects("tolerance = -1", "tolerance", [&] { direct_solve(t.rows, t.V, {.tolerance = -1}, factors); });
  std::vector<Row<6>> none;
  expect_true("no rows are solved", "Eq. (11.13)", direct_solve(none, t.V, {}, factors).converged);
}

}  // namespace
