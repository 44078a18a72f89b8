// Beyond chapter 12's own tests: units, null directions, and a wire without tension.
#include "12_stiff_wires/stiff_wires.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(TransverseFrequency, "12.1 transverse_frequency");
EXERCISE(GeometricStiffness, "12.2 geometric_stiffness");
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

}  // namespace
