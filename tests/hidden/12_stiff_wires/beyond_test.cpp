// Beyond chapter 12's own tests: units, null directions, the equations that are solved.
#include <tuple>
#include "12_stiff_wires/stiff_wires.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(TransverseFrequency, "12.1 transverse_frequency");
EXERCISE(GeometricStiffness, "12.2 geometric_stiffness");
EXERCISE(StiffenedMatrix, "12.3 stiffened_matrix");
EXERCISE(StiffSolve, "12.4 stiff_solve");

EXERCISE_TEST(TransverseFrequency, GoesWithTheRootOfTheTension) {
  Random random;
  const double T = random.log_uniform(1, 1e5), m = random.log_uniform(0.01, 10),
               l = random.log_uniform(0.01, 1);
  const double omega = transverse_frequency(T, m, l);
  expect_near("ω² m l/T", "Eq. (12.1)", omega * omega * m * l / T, 4, roundings(64));
  expect_near("ω of four times the tension [1/s]", "Eq. (12.1)", transverse_frequency(4 * T, m, l), 2 * omega,
              roundings(16, 2 * omega));
}

EXERCISE_TEST(GeometricStiffness, ActsAcrossTheLinkAlone) {
  Random random;
  const Vec3 n = random.unit_vector();
  const double T = random.log_uniform(1, 1e4), l = random.log_uniform(0.1, 2);
  const Mat3 K = geometric_stiffness(n, l, T);
  const Vec3 across = n.cross(random.unit_vector());
  expect_near_vector("K n [N/m]", "Eq. (12.3)", Vec3(K * n), Vec3(0, 0, 0), roundings(32, T / l));
  expect_near_vector("K of a direction across [N/m]", "Eq. (12.3)", Vec3(K * across), Vec3(T / l * across),
                     roundings(32, T / l));
}

EXERCISE_TEST(StiffSolve, IsTheDirectSolverWithoutStiffness) {
  Random random;
  Motion<3> motion;
  for (int k = 0; k < 6; ++k) {
    motion.inverse_mass.push_back({.linear = k == 0 ? 0 : random.uniform(0.5, 2)});
    motion.W.push_back(k == 0 ? Vec3::Zero() : random.vector());
    motion.Wf.push_back(k == 0 ? Vec3::Zero() : Vec3(0, 0, -0.1));
  }
  std::vector<Row<3>> rows;
  for (int k = 0; k < 5; ++k) {
    const Vec3 n = random.unit_vector();
    rows.push_back(make_row<3>({.i = k,
                                .j = k + 1,
                                .Gi = -n,
                                .Gj = n,
                                .gap = random.uniform(-0.01, 0.01),
                                .spook = {.a = 4, .b = 0.8, .Sigma = 0.01},
                                .lo = -infinity,
                                .hi = infinity},
                               motion));
  }
  std::vector<Row<3>> direct = rows;
  std::vector<Twist<3>> V(6, Twist<3>::Zero()), expected = V;
  Factors factors, of_direct;
  expect_true("it is solved", "Eq. (12.6)", stiff_solve(rows, motion, {}, 0.01, V, factors));
  saddle_solve(direct, motion.inverse_mass, expected, of_direct);
  for (std::size_t k = 0; k < rows.size(); ++k)
    expect_near("λ of link " + std::to_string(k) + " [N s]", "Eq. (12.6)", rows[k].lambda, direct[k].lambda,
                roundings(1e5, 1 + std::abs(direct[k].lambda)));  // S has a condition of a few hundred
}

EXERCISE_TEST(TransverseFrequency, IsRefusedWhereItMakesNoSense) {
  expect_near("ω without tension [1/s]", "Eq. (12.1)", transverse_frequency(0, 1, 1), 0, {0, "exact"});
  for (const double bad : {-1.0, std::nan("")}) {
    expect_rejects("tension = " + std::to_string(bad), "tension", [&] { transverse_frequency(bad, 1, 1); });
    expect_rejects("mass = " + std::to_string(bad), "mass", [&] { transverse_frequency(1, bad, 1); });
    expect_rejects("length = " + std::to_string(bad), "length", [&] { transverse_frequency(1, 1, bad); });
  }
}

EXERCISE_TEST(GeometricStiffness, HasNoneWithoutTension) {
  Random random;
  for (const double tension : {0.0, -5.0, 1e-9, 1e9}) {
    const Vec3 n = random.unit_vector();
    Mat3 expected = Mat3::Zero();
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) expected(a, b) = std::max(tension, 0.0) / 0.5 * ((a == b) - n[a] * n[b]);
    expect_near("largest difference of K over its size", "Eq. (12.3)",
                (geometric_stiffness(n, 0.5, tension) - expected).cwiseAbs().maxCoeff(), 0,
                roundings(16, tension));
  }
}

/// A wire with links in both orders of their bodies, of which the first and another are static.
struct Net3 {
  Random random;
  Motion<3> motion;
  std::vector<Row<3>> rows;
  std::vector<Stiffness> stiffness;

  Net3() {
    for (int b = 0; b < 7; ++b) {
      const bool fixed = b == 0 || b == 4;
      motion.inverse_mass.push_back({.linear = fixed ? 0 : random.uniform(0.5, 2)});
      motion.W.push_back(fixed ? Vec3(0, 0, 0) : random.vector());
      motion.Wf.push_back(fixed ? Vec3(0, 0, 0) : random.vector(0.2));
    }
    for (int k = 0; k < 6; ++k) {
      const Vec3 n = random.unit_vector();
      const int i = k % 2 ? k + 1 : k, j = k % 2 ? k : k + 1;
      rows.push_back(make_row<3>({.i = i,
                                  .j = j,
                                  .Gi = -n,
                                  .Gj = n,
                                  .gap = random.uniform(-0.01, 0.01),
                                  .spook = {.a = 4, .b = 0.8, .Sigma = 0.01},
                                  .lo = -infinity,
                                  .hi = infinity},
                                 motion));
      const Vec3 m = random.unit_vector();
      stiffness.push_back({i, j, random.uniform(10, 1000) * (Mat3::Identity() - m * m.transpose())});
    }
  }

  bool moves(int b) const { return motion.inverse_mass[static_cast<std::size_t>(b)].linear > 0; }

  /// M̃, with the identity for static bodies: Eq. (12.5).
  Eigen::MatrixXd mass(double h) const {
    Eigen::MatrixXd M = Eigen::MatrixXd::Identity(21, 21);
    for (int b = 0; b < 7; ++b)
      if (moves(b)) M.block<3, 3>(3 * b, 3 * b) /= motion.inverse_mass[static_cast<std::size_t>(b)].linear;
    for (const auto& [i, j, K] : stiffness)
      for (const int a : {i, j})
        for (const int b : {i, j})
          if (moves(a) && moves(b)) M.block<3, 3>(3 * a, 3 * b) += (a == b ? h * h : -h * h) * K;
    return M;
  }
  Eigen::MatrixXd jacobian() const {
    Eigen::MatrixXd G = Eigen::MatrixXd::Zero(6, 21);
    for (int k = 0; k < 6; ++k) {
      const Row<3>& row = rows[static_cast<std::size_t>(k)];
      if (moves(row.i)) G.block<1, 3>(k, 3 * row.i) = row.Gi.transpose();
      if (moves(row.j)) G.block<1, 3>(k, 3 * row.j) = row.Gj.transpose();
    }
    return G;
  }
};

EXERCISE_TEST(StiffenedMatrix, AddsStiffnessToTheMasses) {
  const Net3 t;
  const double h = 0.05;
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(27, 27);
  expected.topLeftCorner(21, 21) = t.mass(h).triangularView<Eigen::Lower>();
  expected.bottomLeftCorner(6, 21) = t.jacobian();
  for (int k = 0; k < 6; ++k) expected(21 + k, 21 + k) = -0.01;
  const SparseMatrix A = stiffened_matrix(t.rows, t.motion.inverse_mass, t.stiffness, h);
  expect_true("its size is three for each body, and one for each row", "Eq. (12.5)",
              A.rows() == 27 && A.cols() == 27);
  if (A.rows() != 27 || A.cols() != 27) return;
  expect_near("largest difference on and below the diagonal", "Eq. (12.5)",
              (Eigen::MatrixXd(A) - expected).cwiseAbs().maxCoeff(), 0,
              roundings(64, expected.cwiseAbs().maxCoeff()));
}

EXERCISE_TEST(StiffSolve, SolvesTheStiffenedEquations) {
  Net3 t;
  const double h = 0.05;
  Factors factors;
  std::vector<Twist<3>> V(7, Twist<3>::Zero());
  expect_true("it is solved", "Eq. (12.6)", stiff_solve(t.rows, t.motion, t.stiffness, h, V, factors));
  Eigen::VectorXd all(21), right = Eigen::VectorXd::Zero(21), lambda(6), B(6);
  for (int b = 0; b < 7; ++b) all.segment<3>(3 * b) = V[static_cast<std::size_t>(b)];
  for (int k = 0; k < 6; ++k)
    lambda[k] = t.rows[static_cast<std::size_t>(k)].lambda, B[k] = t.rows[static_cast<std::size_t>(k)].B;
  for (const auto& [i, j, K] : t.stiffness) {
    const Vec3 push =
        h * h * K * (t.motion.Wf[static_cast<std::size_t>(j)] - t.motion.Wf[static_cast<std::size_t>(i)]);
    if (t.moves(i)) right.segment<3>(3 * i) += push;
    if (t.moves(j)) right.segment<3>(3 * j) -= push;
  }
  expect_near_vector<Eigen::VectorXd>("M̃ V - Gᵀ λ [N s]", "Eq. (12.6)",
                                      Eigen::VectorXd(t.mass(h) * all - t.jacobian().transpose() * lambda),
                                      right, {1e-11, "round-off"});
  expect_near_vector<Eigen::VectorXd>("G V + Σ λ [m/s]", "Eq. (12.6)",
                                      Eigen::VectorXd(t.jacobian() * all + 0.01 * lambda), B,
                                      {1e-11, "round-off"});
  std::vector<Row<3>> twice = {t.rows[0], t.rows[0]};
  for (Row<3>& row : twice) row.Sigma = 0;
  expect_true("two equal rows without Σ are refused", "Eq. (12.6)",
              !stiff_solve(twice, t.motion, {}, h, V, factors));
}

}  // namespace
