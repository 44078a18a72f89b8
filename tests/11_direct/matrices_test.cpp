// The matrices: S, and the saddle point from which it comes.
#include <functional>

#include "exercise_test.hpp"
#include "operations.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SchurComplement, "11.1 schur_complement");
EXERCISE(SaddleMatrix, "11.2 saddle_matrix");

std::string entry(std::size_t k, std::size_t l) {
  return "entry (" + std::to_string(k) + ", " + std::to_string(l) + ")";
}

// Tells if two rows meet at i and i, i and j, and so on: a wrong entry depends on that.
std::string meeting(const Row<6>& a, const Row<6>& b) {
  const auto body = [](const Row<6>& row) { return std::to_string(row.i) + "-" + std::to_string(row.j); };
  return ", rows between bodies " + body(a) + " and " + body(b);
}

EXERCISE_TEST(SchurComplement, AgreesWithTheDenseMatrix) {
  Random random;
  for (int repeat = 0; repeat < 10; ++repeat) {
    const System<6> s = random_system(random, 5, 12);
    const MatrixXd S = full(schur_complement(s.rows)), expected = dense_S(s.rows);
    for (std::size_t k = 0; k < s.rows.size(); ++k)
      for (std::size_t l = 0; l <= k; ++l) {
        const Row<6>&a = s.rows[k], &b = s.rows[l];
        const auto as_if_i = [](const Row<6>& one, const Row<6>& other) {
          return (one.i == other.i || one.i == other.j ? one.MinvGi.dot(other.Gi) : 0) +
                 (one.j == other.i || one.j == other.j ? one.MinvGj.dot(other.Gi) : 0);
        };
        const std::string one_block = "Row l's block is Gi on its body i, and Gj on its body j.";
        expect_near(entry(k, l) + " of S" + meeting(a, b) + " [1/kg]", "Eq. (11.1)", S(k, l), expected(k, l),
                    roundings(40, 10),
                    {{expected(k, l) - (k == l ? a.Sigma : 0), "Σ is missing from the diagonal."},
                     {expected(k, l) + (k == l ? 0 : a.Sigma), "Add Σ to the diagonal only."},
                     {as_if_i(a, b), one_block},
                     {as_if_i(b, a), one_block},
                     {expected(k, l) == 0 ? HUGE_VAL : 0,
                      "There is no entry, but the rows share a body. Is it in the other triangle? Row and body "
                      "may meet at i and j, too."}},
                    "Each body that the two rows share adds M⁻¹Gᵀ of one row times G of the other.");
      }
  }
}

EXERCISE_TEST(SchurComplement, AddsBothBodiesOfTheSamePair) {
  Random random;
  System<6> two = random_system(random, 3, 0);
  for (int repeat = 0; repeat < 4; ++repeat) {
    const Twist<6> Gi = random.twist();
    const Twist<6> Gj = random.twist();
    const bool turned = repeat % 2 == 1;  // the same pair from the other side
    two.add({.i = turned ? 2 : 1,
             .j = turned ? 1 : 2,
             .Gi = Gi,
             .Gj = Gj,
             .gap = 0,
             .spook = {.a = 0, .b = 1, .Sigma = 0.1}});
  }
  const MatrixXd S = full(schur_complement(two.rows)), expected = dense_S(two.rows);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t l = 0; l < k; ++l)
      expect_near(entry(k, l) + " of S" + meeting(two.rows[k], two.rows[l]) + " [1/kg]", "Eq. (11.1)", S(k, l),
                  expected(k, l), roundings(40, 20), {},
                  "Rows that share two bodies have a share from each: add both.");
}

// Few rows between bodies with high numbers: a scene has thousands of bodies, and three of them touch.
EXERCISE_TEST(SchurComplement, TakesBodiesOfAnyNumber) {
  Random random;
  System<6> s = random_system(random, 3, 5);
  const MatrixXd expected = dense_S(s.rows);
  const std::string of = " of S, of five rows between bodies 70, 9000 and 4711 [1/kg]";
  const int numbers[] = {70, 9000, 4711};
  for (Row<6>& row : s.rows) row.i = numbers[row.i], row.j = numbers[row.j];
  const SparseMatrix S = schur_complement(s.rows);
  expect_true("S is 5 by 5", "Eq. (11.1)", S.rows() == 5 && S.cols() == 5);
  if (::testing::Test::HasFailure()) return;
  for (std::size_t k = 0; k < 5; ++k)
    for (std::size_t l = 0; l <= k; ++l)
      expect_near(entry(k, l) + of, "Eq. (11.1)", full(S)(k, l), expected(k, l), roundings(40, 10), {},
                  "The number of a body says nothing about the number of rows: it may be far above it.");
}

EXERCISE_TEST(SchurComplement, IsALowerTriangle) {
  Random random;
  const System<6> s = random_system(random, 4, 10);
  const SparseMatrix S = schur_complement(s.rows);
  expect_true("S is 10 by 10", "Eq. (11.1)", S.rows() == 10 && S.cols() == 10);
  expect_true("S is compressed", "Eq. (11.1)", S.isCompressed(),
              "setFromTriplets leaves it compressed; after insert, call makeCompressed.");
  int above = 0, diagonal = 0;
  for (int column = 0; column < S.cols(); ++column)
    for (SparseMatrix::InnerIterator at(S, column); at; ++at) {
      above += at.row() < at.col();
      diagonal += at.row() == at.col();
    }
  expect_near("entries above the diagonal", "Eq. (11.1)", above, 0, {0, "a count"}, {},
              "Functions that read the matrix take the upper triangle from the lower.");
  expect_near("entries on the diagonal", "Eq. (11.1)", diagonal, 10, {0, "a count"});
}

EXERCISE_TEST(SchurComplement, OfAWireHasTwoEntriesALink) {
  for (const int links : {1, 2, 50, 1000}) {
    const System<3> wire = HangingWire{.links = links, .ratio = 10, .k = 1e6, .h = 0.01}.system();
    const SparseMatrix S = schur_complement(wire.rows);
    expect_near("entries of S for a wire of " + std::to_string(links) + " links", "Eq. (11.1)",
                static_cast<double>(S.nonZeros()), 2 * links - 1, {0, "each link, and each pair of neighbours"},
                {{links * (links + 1) / 2.0, "Every pair of rows has an entry, most of them 0."},
                 {3.0 * links - 2, "Both triangles are stored."}},
                "Rows that share no dynamic body have no entry.");
  }
}

EXERCISE_TEST(SchurComplement, DoesNotCompareAllPairs) {
  const auto operations = [](int links) {
    const System<3> wire = HangingWire{.links = links, .ratio = 10, .k = 1e6, .h = 0.01}.system();
    return operations_of([&] { schur_complement(wire.rows); });
  };
  expect_growth(
      "the matrix of a wire of 2,000 links", "Eq. (11.1)", operations(250), operations(2000), 2000, 12,
      "work proportional to links makes it 8, to pairs of links 64",
      "All pairs are compared, or the work grows like that. Make a list of the rows of each body first.");
}

EXERCISE_TEST(SchurComplement, DoesNotCompareAllThatLieOnTheFloor) {
  const auto operations = [](int bodies) {
    System<3> s;
    const Twist<3> up(0, 0, 1);
    s.add(0, Twist<3>::Zero());
    for (int body = 1; body <= bodies; ++body) {
      s.add(0.5, -0.1 * up);
      s.add({.i = 0, .j = body, .Gi = -up, .Gj = up, .gap = 0, .spook = {.a = 0, .b = 1, .Sigma = 0.5}});
    }
    return operations_of([&] { schur_complement(s.rows); });
  };
  expect_growth("the matrix of 2,000 bodies on one floor", "Eq. (11.1)", operations(250), operations(2000),
                2000, 12, "work proportional to bodies makes it 8, to pairs of bodies 64",
                "For each row all others of the floor were visited. A static body couples no rows: do not go "
                "through its list.");
}

EXERCISE_TEST(SchurComplement, RowsThatShareOnlyTheFloorHaveNoEntry) {
  System<3> s;
  const Twist<3> up(0, 0, 1);
  s.add(0, Twist<3>::Zero());
  for (int body = 1; body <= 20; ++body) {
    s.add(0.5, -0.1 * up);
    const bool turned = body % 2 == 0;
    s.add({.i = turned ? body : 0,
           .j = turned ? 0 : body,
           .Gi = turned ? up : -up,
           .Gj = turned ? -up : up,
           .gap = 0,
           .spook = {.a = 0, .b = 1, .Sigma = 0.5}});
  }
  const SparseMatrix S = schur_complement(s.rows);
  expect_near("entries of S for 20 bodies side by side on a floor", "Eq. (11.1)",
              static_cast<double>(S.nonZeros()), 20, {0, "no two rows share a dynamic body"}, {},
              "A static body couples no rows: M⁻¹Gᵀ is 0 there, and so is the entry. Leave it out.");
}

EXERCISE_TEST(SchurComplement, OfAStarHasAllPairs) {
  Random random;
  for (const int points : {1, 10, 60, 300}) {
    const System<3> s = star(random, points);
    expect_near("entries of S for a star of " + std::to_string(points) + " points", "Eq. (11.1)",
                static_cast<double>(schur_complement(s.rows).nonZeros()), points * (points + 1) / 2.0,
                {0, "every row shares the middle with every other"});
  }
}

// Eq. (11.2) as a dense matrix.
MatrixXd dense_saddle(const std::vector<Row<6>>& rows, const std::vector<InverseMass<6>>& inverse_mass) {
  const auto bodies = std::ssize(inverse_mass), n = 6 * bodies + std::ssize(rows);
  MatrixXd A = MatrixXd::Zero(n, n);
  for (Eigen::Index body = 0; body < bodies; ++body) {
    const InverseMass<6>& inverse = inverse_mass[body];
    Eigen::Matrix<double, 6, 6> M = Eigen::Matrix<double, 6, 6>::Identity();
    if (inverse.linear > 0) {
      M.topLeftCorner<3, 3>() /= inverse.linear;
      M.bottomRightCorner<3, 3>() = inverse.angular.inverse();
    }
    A.block<6, 6>(6 * body, 6 * body) = M;
  }
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Eigen::Index line = 6 * bodies + static_cast<Eigen::Index>(k);
    const Row<6>& row = rows[k];
    if (inverse_mass[row.i].linear > 0) A.block<1, 6>(line, 6 * row.i) = row.Gi.transpose();
    if (inverse_mass[row.j].linear > 0) A.block<1, 6>(line, 6 * row.j) = row.Gj.transpose();
    A(line, line) = -row.Sigma;
  }
  return MatrixXd(A.selfadjointView<Eigen::Lower>());
}

std::string part_of(Eigen::Index line, Eigen::Index column, Eigen::Index velocities) {
  if (column >= velocities) return line == column ? " (on the diagonal of -Σ)" : " (between rows)";
  return line >= velocities ? " (in G)" : " (in M)";
}

EXERCISE_TEST(SaddleMatrix, AgreesWithTheDenseMatrix) {
  Random random;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const System<6> s = random_system(random, 3, 4);
    const SparseMatrix A = saddle_matrix(s.rows, s.motion.inverse_mass);
    const MatrixXd expected = dense_saddle(s.rows, s.motion.inverse_mass);
    expect_true("the matrix has 6 unknowns for each of 3 bodies, and 4 for the rows", "Eq. (11.2)",
                A.rows() == 22 && A.cols() == 22);
    if (A.rows() != 22 || A.cols() != 22) return;
    const MatrixXd got = MatrixXd(A).triangularView<Eigen::Lower>();
    for (Eigen::Index line = 0; line < 22; ++line)
      for (Eigen::Index column = 0; column <= line; ++column) {
        const double right = expected(line, column);
        const bool turns = line < 18 && line / 6 == column / 6 && line % 6 > 2 && column % 6 > 2;
        const auto& inverse = s.motion.inverse_mass[static_cast<std::size_t>(column / 6 % 3)].angular;
        const double inverted = turns ? inverse(line % 6 - 3, column % 6 - 3) : right;
        expect_near(
            entry(line, column) + part_of(line, column, 18), "Eq. (11.2)", got(line, column), right,
            {1e-13, "an inverse of 3 by 3 with a condition up to 10"},
            {{inverted, "This is from I⁻¹, which InverseMass has. The entry is from I, its inverse, 3 by 3."},
             {line >= 18 ? -right : right, "The sign: it is +G, and -Σ."},
             {line < 18 && right != 0 ? 1 / right : right, "This is from M⁻¹: the entry is from M."},
             {turns && line == column ? 1 / inverted : right,
              "This is 1 over an entry of I⁻¹. Invert all of I⁻¹, 3 by 3, with its off-diagonal entries."},
             {right == 0 ? HUGE_VAL : 0,
              line >= 18
                  ? "There is no entry: G is below M, on the line of its row, in the columns of its body."
              : column < 6 ? "A static body has the identity for its M, 6 by 6."
                           : "There is no entry: M of a rigid body has m three times and, below it, the lower "
                             "triangle of the 3 by 3 block I."},
             {line >= 18 && column < 6 && right == 0 ? got(line, column) : right,
              "Body 0 is static: a row has no entries on it, whether it is i or j."}},
            "The first unknowns are six for each body, then comes one for each row.");
      }
  }
}

EXERCISE_TEST(SaddleMatrix, KeepsStaticBodiesAtRest) {
  Random random;
  System<6> s = random_system(random, 2, 3);
  const MatrixXd A = full(saddle_matrix(s.rows, s.motion.inverse_mass));
  expect_near_vector("M of a static body, its diagonal", "Eq. (11.2)", VectorXd(A.diagonal().head<6>()),
                     VectorXd::Ones(6), {0, "exact"},
                     {{VectorXd::Zero(6), "Its mass is not 0 but infinite. The identity keeps its V at 0."}});
  expect_near_vector("blocks of that body in the rows, each by the norm of its G", "Eq. (11.2)",
                     VectorXd(A.block(12, 0, 3, 6).rowwise().norm()), VectorXd::Zero(3), {0, "exact"}, {},
                     "Leave out G of a static body: otherwise it moves as a body of 1 kg does.");
}

EXERCISE_TEST(SaddleMatrix, OfPointsHasThreeUnknownsForEach) {
  const System<3> s = HangingWire{.links = 3, .ratio = 7, .k = 1e4, .h = 0.01}.system();
  const MatrixXd A = full(saddle_matrix(s.rows, s.motion.inverse_mass));
  expect_near("unknowns of a wire: three for each of 4 points, and 3 rows", "Eq. (11.2)",
              static_cast<double>(A.rows()), 15, {0, "a count"});
  if (A.rows() != 15) return;
  for (int line = 0; line < 12; ++line)
    for (int column = 0; column <= line; ++column) {
      const double expected = line != column ? 0 : line >= 9 ? 7 : 1;
      expect_near(
          entry(static_cast<std::size_t>(line), static_cast<std::size_t>(column)) +
              ", of the masses of points [kg]: the first is static, the last has 7 kg",
          "Eq. (11.2)", A(line, column), expected, roundings(4, 7),
          {{1.0 / 7, "This is from M⁻¹: the entry is from M."}},
          "M of a point is its mass times the identity, 3 by 3; that of a static body is the identity.");
    }
}

EXERCISE_TEST(SaddleMatrix, IsALowerTriangle) {
  Random random;
  const System<6> s = random_system(random, 4, 5);
  const SparseMatrix A = saddle_matrix(s.rows, s.motion.inverse_mass);
  int above = 0;
  for (int column = 0; column < A.cols(); ++column)
    for (SparseMatrix::InnerIterator at(A, column); at; ++at) above += at.row() < at.col();
  expect_true("the matrix is compressed", "Eq. (11.2)", A.isCompressed());
  expect_near("entries above the diagonal", "Eq. (11.2)", above, 0, {0, "a count"}, {},
              "Store the lower triangle only: G, and not Gᵀ, and of the blocks of M the part below the "
              "diagonal and the diagonal.");
}

EXERCISE_TEST(SaddleMatrix, OfAStarGrowsWithItsRows) {
  Random random;
  for (const int points : {10, 100, 1000}) {
    const System<3> s = star(random, points);
    const SparseMatrix A = saddle_matrix(s.rows, s.motion.inverse_mass);
    // S of the same star has n(n+1)/2.
    expect_at_most("entries for a star of " + std::to_string(points) + " points", "Eq. (11.2)",
                   static_cast<double>(A.nonZeros()), 6 * (points + 1) + 7 * points,
                   "at most 6 for each body, 6 for G and 1 for Σ for each row");
    expect_at_least("entries for a star of " + std::to_string(points) + " points", "Eq. (11.2)",
                    static_cast<double>(A.nonZeros()), 3 * (points + 1) + 6 * points, "M and G of each");
  }
}

}  // namespace
