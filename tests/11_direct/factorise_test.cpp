// L, D and P: correct, analysed once for a pattern, and refused when a pivot is round-off.
#include "exercise_test.hpp"
#include "random_input.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(Factorise, "11.3 factorise");

// A sparse positive definite matrix: an undirected graph with `edges` of the n(n-1)/2 pairs.
MatrixXd random_spd(Random& random, int n, int edges) {
  MatrixXd A = MatrixXd::Zero(n, n);
  for (int edge = 0; edge < edges; ++edge) {
    const int k = random.integer(0, n - 1), l = (k + random.integer(1, n - 1)) % n;
    A(k, l) = A(l, k) = random.uniform(-1, 1);
  }
  for (int k = 0; k < n; ++k) A(k, k) = A.row(k).cwiseAbs().sum() + random.uniform(0.1, 1);
  return A;
}

void expect_solves(const std::string& what, const MatrixXd& A, const Factors& factors) {
  const VectorXd x = VectorXd::LinSpaced(A.rows(), 1, 2);
  const VectorXd right = A * x;
  expect_near_vector("x of A x = b, " + what, "Eq. (11.3)", VectorXd(factors.ldlt.solve(right)), x,
                     {1e-11 * x.norm(), "1e-15 times a condition of up to 1e3, and some more"}, {},
                     "Compute the numbers anew for each matrix, whether its pattern is known or not.");
}

EXERCISE_TEST(Factorise, RebuildsTheMatrix) {
  Random random;
  for (const int n : {1, 2, 7, 30}) {
    const MatrixXd A = n == 1 ? MatrixXd::Constant(1, 1, 3.0) : random_spd(random, n, 2 * n);
    Factors factors;
    expect_true("a positive definite matrix is sound", "Eq. (11.4)", factorise(lower_triangle(A), factors));
    if (factors.ldlt.info() != Eigen::Success || factors.ldlt.vectorD().size() != n) return;
    const MatrixXd L = SparseMatrix(factors.ldlt.matrixL());
    const MatrixXd P = MatrixXd(factors.ldlt.permutationP().toDenseMatrix().cast<double>());
    const MatrixXd rebuilt = L * VectorXd(factors.ldlt.vectorD()).asDiagonal() * L.transpose();
    expect_near("|L D Lᵀ - P A Pᵀ|, n = " + std::to_string(n), "Eq. (11.3)",
                (rebuilt - P * A * P.transpose()).norm(), 0, {1e-14 * A.norm() * n, "roundings"});
    expect_solves("n = " + std::to_string(n), A, factors);
  }
}

EXERCISE_TEST(Factorise, LooksForAPatternOnce) {
  Random random;
  const MatrixXd A = random_spd(random, 12, 20);
  Factors factors;
  expect_true("factorise accepts this matrix", "Eq. (11.4)", factorise(lower_triangle(A), factors));
  for (int again = 0; again < 5; ++again) {
    MatrixXd other = A * random.uniform(0.5, 2);
    other.diagonal() *= random.uniform(1.5, 3);
    expect_true("factorise accepts this matrix", "Eq. (11.4)", factorise(lower_triangle(other), factors));
    expect_solves("other numbers in the same places", other, factors);
  }
  expect_near(
      "analyses of 6 matrices with one pattern", "Eq. (11.3)", factors.analyses, 1, {0, "a count"},
      {{6, "Only the places of entries matter, not the numbers. Compare them by `columns` and `entries`."},
       {0, "`analyses` counts how often analyzePattern was called."}});

  Factors after_failure;
  const MatrixXd ones = MatrixXd::Ones(12, 12);  // its second pivot is 1 - 1
  expect_true("a matrix of ones is not sound", "Eq. (11.4)", !factorise(lower_triangle(ones), after_failure));
  const MatrixXd more = ones + MatrixXd::Identity(12, 12);
  expect_true("factorise accepts this matrix", "Eq. (11.4)", factorise(lower_triangle(more), after_failure));
  expect_near("analyses of a matrix that fails, and of one with its pattern", "Eq. (11.3)",
              after_failure.analyses, 1, {0, "a count"},
              {{2, "The pattern of a matrix that failed is the last one, too: note it before you factorise."}});
}

// Two hubs, 0 and 1, each tied to all others. Eliminating the others fills in (0, 1).
MatrixXd two_hubs(int n) {
  MatrixXd A = 4.0 * n * MatrixXd::Identity(n, n);
  for (int k = 2; k < n; ++k)
    for (const int hub : {0, 1}) A(k, hub) = A(hub, k) = 1 + 0.1 * k;
  return A;
}

EXERCISE_TEST(Factorise, LooksAgainForAnotherPattern) {
  Factors factors;
  MatrixXd A = two_hubs(8);
  expect_true("factorise accepts this matrix", "Eq. (11.4)", factorise(lower_triangle(A), factors));
  // First an entry fewer: its place is known to the old factors. With an entry elsewhere Eigen would abort the program.
  A(2, 1) = A(1, 2) = 0;
  expect_true("factorise accepts this matrix", "Eq. (11.4)", factorise(lower_triangle(A), factors));
  expect_near("analyses after an entry is gone", "Eq. (11.3)", factors.analyses, 2, {0, "a count"},
              {{1,
                "Its entries have other places than those of the last one: look for P and the pattern again. "
                "Eigen does not check this, and aborts the program where there are more."}});
  if (factors.analyses != 2) return;
  expect_solves("an entry fewer", A, factors);
  A(2, 0) = A(0, 2) = 0, A(1, 0) = A(0, 1) = 1;  // as many entries, one of them elsewhere
  expect_true("factorise accepts this matrix", "Eq. (11.4)", factorise(lower_triangle(A), factors));
  expect_near("analyses after an entry has moved", "Eq. (11.3)", factors.analyses, 3, {0, "a count"},
              {{2, "Compare where the entries are, not how many there are."}});
  expect_solves("as many entries, elsewhere", A, factors);
}

EXERCISE_TEST(Factorise, LooksAtColumnsAsWellAsLines) {
  // Entries in rows 0 and 1 of the matrix: both in one column, then in two. (The first has none at its last pivot.)
  Factors factors;
  MatrixXd A(2, 2);
  A << 2, 1, 1, 0;
  SparseMatrix one_column = lower_triangle(A);
  one_column.prune(0.0);
  factorise(one_column, factors);
  A << 2, 0, 0, 3;
  expect_true("factorise accepts this matrix", "Eq. (11.4)", factorise(lower_triangle(A), factors));
  expect_near("analyses of two matrices with entries in rows 0 and 1", "Eq. (11.3)", factors.analyses, 2,
              {0, "a count"}, {{1, "All row indices are alike, but not where the columns begin."}});
  expect_solves("two columns after one", A, factors);
}

EXERCISE_TEST(Factorise, RefusesTheSameRowTwice) {
  Random random;
  const std::string what = "the same row twice, with Σ = 0, is refused";
  const std::string clue =
      "The second pivot is a difference of equal numbers: 0, or round-off. Its size says nothing: compare it "
      "with the two numbers.";
  for (int repeat = 0; repeat < 20; ++repeat) {
    const double size = random.log_uniform(1e-8, 1e8);
    Factors factors;
    expect_true(what, "Eq. (11.4)", !factorise(lower_triangle(size * MatrixXd::Ones(2, 2)), factors), clue);
  }
  for (int repeat = 0; repeat < 20; ++repeat) {
    MatrixXd G =
        MatrixXd::NullaryExpr(5, 4, [&] { return random.uniform(-1, 1); });  // 5 rows, 4 degrees of freedom
    G.row(4) = G.row(0) + random.uniform(0.5, 2) * G.row(1);
    Factors factors;
    expect_true("a row that is the sum of two others, with Σ = 0, is refused", "Eq. (11.4)",
                !factorise(lower_triangle(G * G.transpose()), factors), clue);
  }
}

EXERCISE_TEST(Factorise, WeighsEveryPivot) {
  // Fifty pairs of rows. One pair is the same row twice except for round-off: each in turn, since P may put it
  // anywhere.
  const int pairs = many / 2;
  for (int bad = 0; bad < pairs && !::testing::Test::HasFailure(); ++bad) {
    SparseMatrix A(2 * pairs, 2 * pairs);
    for (int k = 0; k < pairs; ++k) {
      A.insert(2 * k, 2 * k) = 1;
      A.insert(2 * k + 1, 2 * k) = 1;
      A.insert(2 * k + 1, 2 * k + 1) = k == bad ? 1 + 1.5e-14 : 2;
    }
    A.makeCompressed();
    Factors factors;
    expect_true(
        "a hundred rows, of which " + std::to_string(2 * bad) + " and the next are equal to within " +
            "1.5e-14, are refused",
        "Eq. (11.4)", !factorise(A, factors),
        "Its pivot is less than 1e-14 (|A_kk| + Σ_j L_kj² |D_j|), wherever P has put it. A loop over the "
        "columns of L that ends early leaves terms out.");
  }
}

EXERCISE_TEST(Factorise, WeighsAPivotAgainstWhatItIsMadeOf) {
  // The second pivot of [a a; a a(1+δ)] is aδ, the difference of a(1+δ) and a.
  for (const double a : {1.0, -1.0, 1e6, -1e-6})
    for (const double delta : {1.5e-14, 3e-14}) {
      MatrixXd A = MatrixXd::Constant(2, 2, a);
      A(1, 1) += a * delta;
      Factors factors;
      const bool sound = factorise(lower_triangle(A), factors);
      const std::string numbers = show(a) + " times [1 1; 1 1+δ], δ = " + show(delta);
      if (delta < 2e-14)
        expect_true(numbers + ", is refused", "Eq. (11.4)", !sound,
                    "The pivot δ is less than 1e-14 (|1 + δ| + |1|). The sum is over all columns before it, "
                    "including the first, and takes absolute values.");
      else
        expect_true(
            numbers + ", is sound", "Eq. (11.4)", sound,
            std::string("The pivot δ is more than 1e-14 (|1 + δ| + |1|).") +
                (a < 0 ? " Here it is negative, which a pivot may be: only its size |D_k| counts." : ""));
    }
}

EXERCISE_TEST(Factorise, RefusesASingularSaddlePoint) {
  Random random;
  int refused = 0;
  for (int repeat = 0; repeat < 20; ++repeat) {
    // Two bodies, and two rows along the same G, to a factor: the diagonal has zeros in place of Σ.
    MatrixXd A = MatrixXd::Zero(4, 4);
    A(0, 0) = random.uniform(0.5, 2), A(1, 1) = random.uniform(0.5, 2);
    A(2, 0) = A(0, 2) = random.uniform(0.5, 1);
    A(2, 1) = A(1, 2) = random.uniform(-1, -0.5);
    A.row(3).head<3>() = random.uniform(0.3, 3) * A.row(2).head<3>();
    A.col(3).head<3>() = A.row(3).head<3>().transpose();
    Factors factors;
    refused += !factorise(lower_triangle(A), factors);
  }
  expect_near("refused of 20 saddle points with the same row twice, and Σ = 0", "Eq. (11.4)", refused, 20,
              {0, "a count"}, {},
              "A_kk alone is 0 here, and no pivot is smaller. What did the elimination subtract?");
}

EXERCISE_TEST(Factorise, TakesWhatIsOnlyIllConditioned) {
  Random random;
  for (const double ratio : {1e3, 1e8, 1e16}) {
    MatrixXd A = MatrixXd::Zero(3, 3);  // a heavy and a light body that do not touch, and one that does
    A.diagonal() << 1, 1 / ratio, 2;
    A(2, 0) = A(0, 2) = 0.5;
    Factors factors;
    expect_true(
        "a mass ratio of " + show(ratio) + " is accepted", "Eq. (11.4)", factorise(lower_triangle(A), factors),
        "A pivot is sound even if others are larger: compare it with its own row. D is in the order of P, "
        "and A is not.");
  }
  Factors factors;
  const MatrixXd twice = MatrixXd::Ones(2, 2) + 1e-9 * MatrixXd::Identity(2, 2);
  expect_true("the same row twice with Σ = 1e-9 is accepted", "Eq. (11.4)",
              factorise(lower_triangle(twice), factors), "Σ is far above round-off.");
}

EXERCISE_TEST(Factorise, JudgesPivotsAlikeAtAnyMass) {
  // A body and a row, [m G; G -Σ], are sound in grams and in tons. With that row twice and Σ = 0 they never are.
  for (const double mass : {1e-12, 1e-6, 1.0, 1e6, 1e18}) {
    MatrixXd once(2, 2), twice(3, 3);
    once << mass, 1, 1, -0.1 / mass;
    twice << mass, 0.7, 0.3, 0.7, 0, 0, 0.3, 0, 0;
    Factors factors, others;
    const std::string clue = "What was subtracted from A_kk is the sum of L_kj² |D_j|: L twice, D once.";
    expect_true("a row on a body of " + show(mass) + " kg is accepted", "Eq. (11.4)",
                factorise(lower_triangle(once), factors), clue);
    expect_true("a row that occurs twice, on a body of " + show(mass) + " kg, is refused", "Eq. (11.4)",
                !factorise(lower_triangle(twice), others), clue);
  }
}

EXERCISE_TEST(Factorise, RefusesPivotsBelowTheStatedLimit) {
  for (const double Sigma : {1e-9, 1e-11, 1e-13}) {
    Factors factors;
    const MatrixXd A = MatrixXd::Ones(2, 2) + Sigma * MatrixXd::Identity(2, 2);
    expect_true("the same row twice with Σ = " + show(Sigma) + " is accepted", "Eq. (11.4)",
                factorise(lower_triangle(A), factors),
                "The second pivot is 2 Σ; 1e-14 of what it is made of is less.");
  }
  Factors factors;
  const MatrixXd A = MatrixXd::Ones(2, 2) + 1e-15 * MatrixXd::Identity(2, 2);
  expect_true("the same row twice with Σ = 1e-15 is refused", "Eq. (11.4)",
              !factorise(lower_triangle(A), factors),
              "The second pivot is 2 Σ, and less than 1e-14 of what it is made of.");
}

EXERCISE_TEST(Factorise, TakesNegativePivots) {
  MatrixXd A(3, 3);
  A << 2, 0, 1, 0, 3, -1, 1, -1, -0.1;  // two bodies and a row
  Factors factors;
  expect_true("a saddle point is accepted", "Eq. (11.4)", factorise(lower_triangle(A), factors),
              "Its pivots have both signs: it is their size that counts.");
  expect_solves("two signs", A, factors);
}

EXERCISE_TEST(Factorise, ComparesAPivotWithItsOwnRow) {
  // A hub with a large diagonal entry: least fill takes it last, so that D has another order than A.
  const int n = 8;
  MatrixXd A = MatrixXd::Identity(n, n);
  A(0, 0) = 1e16;
  for (int k = 1; k < n; ++k) A(k, 0) = A(0, k) = 0.5;
  Factors factors;
  expect_true("a diagonal of 1e16 and ones is accepted", "Eq. (11.4)", factorise(lower_triangle(A), factors),
              "D is in the order of P A Pᵀ, not of A.");
}

EXERCISE_TEST(Factorise, RefusesWhatIsNotFinite) {
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    for (int k = 0; k < 3; ++k) {
      MatrixXd A = MatrixXd::Identity(3, 3);
      A(1, 0) = A(0, 1) = 0.5;
      A(k, k) = bad;
      SparseMatrix lower = lower_triangle(A);
      Factors factors;
      expect_true(
          show(bad) + " on the diagonal is refused", "Eq. (11.4)", !factorise(lower, factors),
          "Every comparison with NaN is false: ask whether a pivot is sound, not whether it is too small.");
    }
  }
}

EXERCISE_TEST(Factorise, GoesOnAfterARefusal) {
  Factors factors;
  const MatrixXd singular = MatrixXd::Ones(2, 2), sound = singular + MatrixXd::Identity(2, 2);
  expect_true("factorise refuses this matrix", "Eq. (11.4)", !factorise(lower_triangle(singular), factors));
  expect_true("accepted, after one with the same pattern was refused", "Eq. (11.4)",
              factorise(lower_triangle(sound), factors));
  expect_solves("after a refusal", sound, factors);
}

}  // namespace
