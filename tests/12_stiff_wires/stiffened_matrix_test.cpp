// M̃ in the saddle-point matrix: by hand, against a dense assembly, and for what springs leave unchanged.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numbers>
#include <set>

#include "exercise_test.hpp"
#include "regions.hpp"
#include "relative_scales.hpp"
#include "springs.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(StiffenedMatrix, "12.3 stiffened_matrix");

Eigen::MatrixXd stiffened(const Springs& s) {
  return entries(stiffened_matrix(s.rows, s.motion.inverse_mass, s.stiffness, s.h), s);
}

EXERCISE_TEST(StiffenedMatrix, PutsASpringBetweenTwoPoints) {
  // 2 kg and 4 kg on a link along z with T/l = 16 N/m; h = 1/2 s.
  Springs s{.h = 0.5};
  s.add(0.5, Vec3::Zero(), Vec3::Zero());
  s.add(0.25, Vec3::Zero(), Vec3::Zero());
  s.add_row(0, 1, Vec3::UnitZ(), 0, {.a = 1, .b = 1, .Sigma = 0.125});
  s.stiffness = {{.i = 0, .j = 1, .K = across(Vec3::UnitZ(), 16)}};
  const Eigen::MatrixXd A = stiffened(s);
  expect_near("entry (0, 0): 2 kg and h²K = 4 kg", "Eq. (12.5)", A(0, 0), 6, {0, "exact"},
              {{2, "There is no K on the diagonal of body i."},
               {18, "This is m + K: without h² it is not even a mass."},
               {10, "This is m + h K: a spring adds the impulse h K times the way h v, so h²K."},
               {4, "Half of K is missing: each end gets all of it, as if the other were held."},
               {3, "This is m + h²K/4, which would suffice if the tension never grew."},
               {-2, "The sign: K resists, so it adds to the mass."},
               {4.5, "This is 1/m, but m belongs here: inverse_mass is 1/m."}});
  expect_near("entry (3, 3): 4 kg and h²K = 4 kg", "Eq. (12.5)", A(3, 3), 8, {0, "exact"},
              {{4, "There is no K on the diagonal of body j."}});
  expect_near("entry (3, 0), below the diagonal: -h²K", "Eq. (12.5)", A(3, 0), -4, {0, "exact"},
              {{0,
                "Nothing couples the two bodies below the diagonal. K acts on their distance, so a common "
                "motion is free."},
               {4, "The sign: K resists only a rotation of the link. For a common motion it must cancel."}});
  expect_near("entry (2, 2), along the link", "Eq. (12.5)", A(2, 2), 2, {0, "exact"});
  expect_near("entry (6, 5), G of the row on body 1", "Eq. (11.2)", A(6, 5), 1, {0, "exact"},
              {{0, "The rows are missing: below M̃ is G, as in Eq. (11.2)."}});
  expect_near("entry (6, 6), -Σ", "Eq. (11.2)", A(6, 6), -0.125, {0, "exact"});
}

EXERCISE_TEST(StiffenedMatrix, IsTheDenseAssembly) {
  Random random;
  Regions regions({"i above j", "i below j", "a spring to a static i above j", "a spring to a static i below j",
                   "a spring to a static j above i", "a spring to a static j below i",
                   "a pair with two springs", "no body is static", "a step of no time"});
  while (regions.lack_draws()) {
    const int bodies = random.integer(3, 8), fixed = random.integer(0, 2);
    const int springs = random.integer(0, 6);
    const bool last_are_fixed = random.integer(0, 1) == 1;
    Springs s = random_springs(random, bodies, fixed, springs, last_are_fixed);
    if (random.integer(0, 4) == 0) s.h = 0;
    for (const bool i_above_j : {false, true}) {  // rows whose two blocks have nothing in common
      const int other = random.integer(0, bodies - 2), last = bodies - 1;
      const Vec3 Gi = random.vector(), Gj = random.vector();
      s.rows.push_back(make_row<3>({.i = i_above_j ? last : other,
                                    .j = i_above_j ? other : last,
                                    .Gi = Gi,
                                    .Gj = Gj,
                                    .gap = 0,
                                    .spook = {.a = 1, .b = 1, .Sigma = 0.1}},
                                   s.motion));
    }
    const auto any = [&](const auto& is) { return std::any_of(s.stiffness.begin(), s.stiffness.end(), is); };
    std::set<std::pair<int, int>> pairs;
    for (const Stiffness& one : s.stiffness) pairs.insert(std::minmax(one.i, one.j));
    regions.draw(
        {{"i above j", any([](const Stiffness& one) { return one.i > one.j; })},
         {"i below j", any([](const Stiffness& one) { return one.i < one.j; })},
         {"a spring to a static i above j",
          any([&](const Stiffness& one) { return !s.moves(one.i) && s.moves(one.j) && one.i > one.j; })},
         {"a spring to a static i below j",
          any([&](const Stiffness& one) { return !s.moves(one.i) && s.moves(one.j) && one.i < one.j; })},
         {"a spring to a static j above i",
          any([&](const Stiffness& one) { return s.moves(one.i) && !s.moves(one.j) && one.j > one.i; })},
         {"a spring to a static j below i",
          any([&](const Stiffness& one) { return s.moves(one.i) && !s.moves(one.j) && one.j < one.i; })},
         {"a pair with two springs", pairs.size() < s.stiffness.size()},
         {"no body is static", !any([&](const Stiffness& one) { return !s.moves(one.i) || !s.moves(one.j); })},
         {"a step of no time", s.h == 0}});
    const std::string of_rows =
        "A row below M̃ has -Σ on the diagonal, its Gi at body i and its Gj at body j. Neither follows from the "
        "other, whichever body has the higher number.";
    const std::string of_springs =
        "Springs in any order, i above j or below it, some that share a body or both: each adds h²K to both of "
        "its bodies' blocks, or to that of the one that moves, and -h²K to the block of the pair that is below "
        "the diagonal. With h = 0 that is 0.";
    const Eigen::MatrixXd A = stiffened(s), right = dense_matrix(s);
    const double size = right.cwiseAbs().maxCoeff();
    for (Eigen::Index column = 0; column < A.cols(); ++column)
      for (Eigen::Index line = column; line < A.rows() && !::testing::Test::HasFailure(); ++line)
        expect_near("entry (" + std::to_string(line) + ", " + std::to_string(column) + ") for " +
                        std::to_string(s.bodies()) + " bodies, " + std::to_string(s.stiffness.size()) +
                        " springs, h = " + show(s.h) + " s",
                    "Eq. (12.5)", A(line, column), right(line, column), roundings(50, size), {},
                    line >= 3 * s.bodies() ? of_rows : of_springs);
  }
}

EXERCISE_TEST(StiffenedMatrix, HasAnyNumberOfSpringsAndRows) {
  Random random;
  const Springs s = random_springs(random, 400, 1, 300);
  const SparseMatrix A = stiffened_matrix(s.rows, s.motion.inverse_mass, s.stiffness, s.h);
  require_size(A, s);
  Eigen::VectorXd x(A.rows());
  for (double& one : x) one = random.uniform(-1, 1);
  const Eigen::VectorXd got = A.selfadjointView<Eigen::Lower>() * x, right = times_matrix(s, x);
  Eigen::Index worst = 0;
  (got - right).cwiseAbs().maxCoeff(&worst);
  expect_near("line " + std::to_string(worst) + " of the matrix of " + std::to_string(s.stiffness.size()) +
                  " springs and " + std::to_string(s.rows.size()) + " rows, times a vector",
              "Eq. (12.5), (11.2)", got[worst], right[worst], roundings(1e3, right.cwiseAbs().maxCoeff()), {},
              "All springs and all rows, however many there are.");
}

EXERCISE_TEST(StiffenedMatrix, HasTheLayoutOfTheSaddlePoint) {
  Random random;
  Springs s = random_springs(random, 6, 1, 3);
  const SparseMatrix A = stiffened_matrix(s.rows, s.motion.inverse_mass, s.stiffness, s.h);
  const Eigen::MatrixXd all = entries(A, s);
  expect_near("sum of the sizes of all entries above the diagonal", "Eq. (12.5)",
              Eigen::MatrixXd(all.triangularView<Eigen::StrictlyUpper>()).cwiseAbs().sum(), 0, {0, "exact"}, {},
              "Store the lower triangle only. For i < j the block of the pair is at line 3j, column 3i.");
  expect_true("the matrix is compressed", "", A.isCompressed(),
              "setFromTriplets compresses; entries inserted later need makeCompressed.");
  s.stiffness.clear();
  const Eigen::MatrixXd without = stiffened(s);
  expect_near("largest difference from saddle_matrix where there are no springs", "Eq. (11.2)",
              (without - entries(saddle_matrix(s.rows, s.motion.inverse_mass), s)).cwiseAbs().maxCoeff(), 0,
              roundings(4, 10), {}, "The first unknowns are three a body, then comes one a row.");
}

EXERCISE_TEST(StiffenedMatrix, AddsNothingToACommonVelocity) {
  Random random;
  Springs s = random_springs(random, 7, 0, 5);
  s.rows.clear();
  const Eigen::MatrixXd lower = stiffened(s), M = lower.selfadjointView<Eigen::Lower>();
  const Vec3 v = random.vector();
  const Eigen::VectorXd momentum = M * v.replicate(7, 1);
  for (int body = 0; body < 7 && !::testing::Test::HasFailure(); ++body)
    expect_near_vector<Vec3>(
        "M̃ times the same velocity of all 7 bodies, at body " + std::to_string(body) + " [N s]", "Eq. (12.5)",
        momentum.segment<3>(3 * body), s.mass(body) * v, roundings(500, 100), {},
        "K acts on distances: each line has as much of +K as of -K, and so momentum is conserved.");
}

EXERCISE_TEST(StiffenedMatrix, CountsTheEnergyOfStretching) {
  Random random;
  Springs s = random_springs(random, 6, 2, 4);
  s.rows.clear();
  const Eigen::MatrixXd lower = stiffened(s), M = lower.selfadjointView<Eigen::Lower>();
  Eigen::VectorXd v(18);
  double expected = 0;
  for (int body = 0; body < 6; ++body) {
    v.segment<3>(3 * body) = s.moves(body) ? random.vector() : Vec3::Zero();
    expected += s.mass(body) * v.segment<3>(3 * body).squaredNorm();
  }
  double springs = 0;
  for (const Stiffness& spring : s.stiffness) {
    const Vec3 apart = v.segment<3>(3 * spring.j) - v.segment<3>(3 * spring.i);
    springs += s.h * s.h * apart.dot(spring.K * apart);
  }
  expect_near("vᵀM̃v of six bodies, two of them static, and nine springs [J]", "Eq. (12.5)", v.dot(M * v),
              expected + springs, roundings(500, expected + springs), {{expected, "There is no K in it."}},
              "The sum has Σ m v² and, for each spring, h² times K between the difference of its two "
              "velocities. (A spring to a static body has one end that moves.)");
}

EXERCISE_TEST(StiffenedMatrix, LeavesWhatIsFixedAlone) {
  Springs s{.h = 0.5};
  s.add(0, Vec3::Zero(), Vec3::Zero());
  s.add(0.5, Vec3::Zero(), Vec3::Zero());
  s.stiffness = {{.i = 0, .j = 1, .K = across(Vec3::UnitZ(), 8)}};
  const Eigen::MatrixXd A = stiffened(s);
  expect_near("entry (0, 0), of a static body", "Eq. (12.5)", A(0, 0), 1, {0, "exact"},
              {{3, "A static body takes no stiffness: no force moves it."}},
              "A static body has the identity for its M: its inverse mass is 0.");
  expect_near("entry (3, 0), between it and a dynamic body", "Eq. (12.5)", A(3, 0), 0, {0, "exact"},
              {{-2, "With this entry the static body would be pulled along. Leave it out, as its G."}});
  expect_near("entry (3, 3), of the dynamic body: 2 kg and 2 kg", "Eq. (12.5)", A(3, 3), 4, {0, "exact"},
              {{2, "A link to a static body is a spring, too: the topmost of every wire."}});
}

EXERCISE_TEST(StiffenedMatrix, KeepsItsPatternWhenAWireGoesSlack) {
  Random random;
  Springs s = random_springs(random, 5, 1, 0);
  const auto tight = stiffened_matrix(s.rows, s.motion.inverse_mass, s.stiffness, s.h).nonZeros();
  for (Stiffness& spring : s.stiffness) spring.K = across(Vec3::UnitX(), 1);
  const auto along_x = stiffened_matrix(s.rows, s.motion.inverse_mass, s.stiffness, s.h).nonZeros();
  for (Stiffness& spring : s.stiffness) spring.K.setZero();
  const auto slack = stiffened_matrix(s.rows, s.motion.inverse_mass, s.stiffness, s.h).nonZeros();
  const std::string clue =
      "A spring has its entries even where they are 0. Otherwise each link that goes slack, or lies along an "
      "axis, makes factorise look for the pattern again.";
  expect_near("entries of a wire of five points that lies along x", "Eq. (12.5)", static_cast<double>(along_x),
              static_cast<double>(tight), {0, "as many as in any direction"}, {}, clue);
  expect_near("entries of it when it is slack", "Eq. (12.5)", static_cast<double>(slack),
              static_cast<double>(tight), {0, "as many as when it is tight"}, {}, clue);
}

EXERCISE_TEST(StiffenedMatrix, MakesEachModeOfAStringHeavier) {
  // N points of mass m between two static ones, along x: across, M̃ is m + h²T/l times (-1, 2, -1).
  Random random;
  const int points = 12;
  const double m = random.log_uniform(0.01, 1), l = random.log_uniform(0.01, 1), T = random.log_uniform(1, 100);
  Springs s{.h = std::sqrt(random.log_uniform(0.1, 100) * m * l / T)};
  for (int k = 0; k <= points + 1; ++k)
    s.add(k == 0 || k == points + 1 ? 0 : 1 / m, Vec3::Zero(), Vec3::Zero());
  for (int k = 0; k <= points; ++k)
    s.stiffness.push_back({.i = k, .j = k + 1, .K = geometric_stiffness(Vec3::UnitX(), l, T)});
  const Eigen::MatrixXd lower = stiffened(s), M = lower.selfadjointView<Eigen::Lower>();
  for (int k = 1; k <= points && !::testing::Test::HasFailure(); ++k) {
    Eigen::VectorXd mode = Eigen::VectorXd::Zero(3 * (points + 2));
    for (int p = 1; p <= points; ++p) mode[3 * p + 1] = std::sin(k * p * std::numbers::pi / (points + 1));
    const double omega = std::sqrt(4 * T / (m * l)) * std::sin(k * std::numbers::pi / (2 * (points + 1)));
    const double expected = m * (1 + std::pow(s.h * omega, 2));
    expect_near("mass of mode " + std::to_string(k) + " of a string of 12 points, h = " + show(s.h) +
                    " s, T = " + show(T) + " N, m = " + show(m) + " kg, l = " + show(l) + " m [kg]",
                "Eq. (12.5), (12.10)", mode.dot(M * mode) / mode.squaredNorm(), expected,
                roundings(500, expected), {{m, "There is no K in it."}}, "m (1 + h²ω²), with ω of that mode.");
  }
}

EXERCISE_TEST(StiffenedMatrix, DropsNothingSmall) {
  for (const double part : relative_scales) {
    Springs s{.h = 0.5};
    s.add(1, Vec3::Zero(), Vec3::Zero());
    s.add(1, Vec3::Zero(), Vec3::Zero());
    s.stiffness = {{.i = 0, .j = 1, .K = 4 * part * Mat3::Identity()}};
    expect_near("entry (3, 0), -h²K, for h²K of " + show(part) + " of the masses", "Eq. (12.5)",
                stiffened(s)(3, 0), -part, roundings(2, part),
                {{0, "The spring has been left out. " + small_is_dropped}}, small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
