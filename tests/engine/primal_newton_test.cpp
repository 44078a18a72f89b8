// Factors on bodies: the same solution as chapter 11's on rows, with any bounds.
#include "engine/solvers/primal_newton.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/solvers/primal_interior_point.hpp"
#include "engine/world/world.hpp"

namespace spook::primal_newton_test {
namespace {

constexpr double h = 1.0 / 60;

/// Rows between random bodies of a random net, some of which are static.
template <int Dof>
struct Random {
  Motion<Dof> motion;
  std::vector<Row<Dof>> rows;
  std::vector<Twist<Dof>> V;

  /// `rub` bounds two of three rows; Σ is that of a contact, and of friction with `viscosity`.
  Random(unsigned seed, int bodies, int contacts, double rub, double viscosity) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto any = [&] {
      Twist<Dof> twist;
      for (double& component : twist) component = uniform(random);
      return twist;
    };
    for (int b = 0; b < bodies; ++b) {
      InverseMass<Dof> inverse{};
      inverse.linear = b % 5 == 0 ? 0 : std::exp(2 * uniform(random));
      if constexpr (Dof == 6)
        if (inverse.linear > 0) {
          Mat3 root = Mat3::Identity();
          for (double& entry : root.reshaped()) entry += 0.3 * uniform(random);
          inverse.angular = inverse.linear * root * root.transpose();
        }
      motion.inverse_mass.push_back(inverse);
      motion.W.push_back(any());
      motion.Wf.push_back(h * any());
    }
    V.assign(motion.W.size(), Twist<Dof>::Zero());
    for (int c = 0; c < contacts; ++c) {
      const int i = static_cast<int>(random() % static_cast<unsigned>(bodies));
      const int j = (i + 1 + static_cast<int>(random() % static_cast<unsigned>(bodies - 1))) % bodies;
      if (i % 5 == 0 && j % 5 == 0) continue;
      for (int k = 0; k < 3; ++k)
        rows.push_back(
            make_row<Dof>({.i = i,
                           .j = j,
                           .Gi = any(),
                           .Gj = any(),
                           .gap = 0.01 * uniform(random),
                           .spook = k == 0 ? spook_parameters(h, 1e6, 3) : friction_parameters(h, viscosity),
                           .lo = k == 0 ? 0 : -rub,
                           .hi = k == 0 ? infinity : rub},
                          motion));
    }
  }
};

/// The largest |Δλ| of two answers, over the largest |λ|.
template <int Dof>
double apart(const std::vector<Row<Dof>>& some, const std::vector<Row<Dof>>& others) {
  double most = 0, largest = 0;
  for (std::size_t k = 0; k < some.size(); ++k) {
    most = std::max(most, std::abs(some[k].lambda - others[k].lambda));
    largest = std::max(largest, std::abs(others[k].lambda));
  }
  return most / largest;
}

template <int Dof>
void expect_answers_of_rows() {
  for (unsigned seed = 1; seed <= 30; ++seed)
    for (const double rub : {infinity, 0.3, 0.01}) {
      Random<Dof> on_bodies(seed, seed % 2 == 0 ? 8 : 5, 20, rub, 1e3);  // 36 or 24 velocities, where Dof is 6
      auto on_rows = on_bodies;
      PrimalFactors<Dof> factors;
      Factors others;
      const auto report =
          primal_newton(on_bodies.rows, on_bodies.motion.inverse_mass, on_bodies.V, {}, factors);
      ASSERT_TRUE(report) << "seed " << seed << ", rub " << rub;
      ASSERT_TRUE(report->converged);
      ASSERT_TRUE(direct_solve(on_rows.rows, on_rows.V, {}, others).converged);
      // Both stop at round-off of B, Eq. (11.13). The softest direction of S turns that into λ: it is a friction row's,
      // with Σ = 1/(h c) = 0.06, about a hundredth of S_kk.
      EXPECT_LE(apart(on_bodies.rows, on_rows.rows), 1e-9) << "seed " << seed << ", rub " << rub;
      std::vector<Twist<Dof>> V(on_bodies.V.size(), Twist<Dof>::Zero());
      for (const Row<Dof>& row : on_bodies.rows) apply_impulse(row, row.lambda, V);
      for (std::size_t b = 0; b < V.size(); ++b) EXPECT_LE((V[b] - on_bodies.V[b]).norm(), 1e-11);
    }
}

TEST(BodySolve, HasTheAnswersOfRows) {
  expect_answers_of_rows<3>();
  expect_answers_of_rows<6>();
}

TEST(BodySolve, FromItsOwnAnswerTakesOneFactorisation) {
  Random<6> s(7, 8, 20, 0.3, 1e3);
  PrimalFactors<6> factors;
  ASSERT_TRUE(primal_newton(s.rows, s.motion.inverse_mass, s.V, {}, factors));
  const auto again = primal_newton(s.rows, s.motion.inverse_mass, s.V, {}, factors);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->history.size(), 1U);
  EXPECT_EQ(factors.factors.analyses(), 1) << "the pattern is that of the bodies, whichever rows are held";
}

TEST(BodySolve, AStackAtRestTakesOneFactorisationAStep) {
  // After the first steps all changes are round-off. The energy is a sum of these, and must not require more.
  for (const double ratio : {1.0, 1e3, 1e6}) {
    World<6> world({.k = 1e6 * ratio, .friction = 0.5, .solver = direct<6>()});
    world.add_plane(Vec3::UnitZ(), 0);
    for (int n = 0; n < 5; ++n) {
      const double mass = n == 4 ? ratio : 1;
      world.add({.x = Vec3(0, 0, n + 0.5),
                 .mass = mass,
                 .principal = solid_box_moments(mass, Vec3::Constant(0.5)),
                 .half_sides = Vec3::Constant(0.5)});
    }
    int most = 0;
    for (int step = 0; step < 200; ++step) {
      world.step(h);
      if (step >= 20) most = std::max(most, world.report().iterations);
    }
    EXPECT_EQ(most, 1) << ratio << ":1";
  }
}

TEST(BodySolve, RefinesWhatASmallSigmaLeaves) {
  // Σ = 1/(h c) = 6e-11: λ = Σ⁻¹ (B - G V) has lost ten digits when it is first computed.
  Random<6> s(3, 8, 12, infinity, 1e12);
  PrimalFactors<6> factors;
  const auto report = primal_newton(s.rows, s.motion.inverse_mass, s.V, {}, factors);
  ASSERT_TRUE(report);
  // Without refinement the residual would be about 1e-6 of B; Eq. (11.13) allows far less.
  EXPECT_LE(residual(s.rows, s.V), roundings(s.rows));
  EXPECT_LT(roundings(s.rows), 1e-10);
}

/// By primal_interior_point alone, which primal_newton calls only if Newton's method makes no progress.
template <int Dof>
SolveReport from_within(Random<Dof>& s) {
  VelocitySystem<Dof> on(s.rows, s.motion.inverse_mass);
  VelocityFactors factors;
  return primal_interior_point(s.rows, on, s.V, {}, factors);
}

template <int Dof>
void expect_answers_of_rows_from_within() {
  for (unsigned seed = 1; seed <= 30; ++seed)
    for (const double rub : {infinity, 0.3, 0.01}) {
      Random<Dof> on_bodies(seed, 8, 20, rub, 1e3);
      on_bodies.rows[3].lo = on_bodies.rows[3].hi = 0.05;  // one that has no room
      auto on_rows = on_bodies;
      ASSERT_TRUE(from_within(on_bodies).converged) << "seed " << seed << ", rub " << rub;
      Factors factors;
      ASSERT_TRUE(direct_solve(on_rows.rows, on_rows.V, {}, factors).converged);
      EXPECT_LE(apart(on_bodies.rows, on_rows.rows), 1e-9) << "seed " << seed << ", rub " << rub;  // as above
      for (std::size_t b = 0; b < on_rows.V.size(); ++b)
        EXPECT_LE((on_bodies.V[b] - on_rows.V[b]).norm(), 1e-9 * (1 + on_rows.V[b].norm()));
    }
}

TEST(BodyInterior, HasTheAnswersOfRows) {
  expect_answers_of_rows_from_within<3>();
  expect_answers_of_rows_from_within<6>();
}

TEST(BodySolve, SolvesFrictionThatIsMoreThanEnough) {
  // A hundred rows on six dynamic bodies, with Σ = 6e-11 of friction. The active set hardly changes the energy, and
  // Newton's method on the free rows never settles.
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Random<6> s(seed, 8, 40, 0.1, 1e12);
    PrimalFactors<6> factors;
    const auto report = primal_newton(s.rows, s.motion.inverse_mass, s.V, {}, factors);
    ASSERT_TRUE(report) << "seed " << seed;
    EXPECT_TRUE(report->converged);
    EXPECT_LE(residual(s.rows, s.V), 1e-12) << "seed " << seed;
  }
}

TEST(BodySolve, LeavesWhatItCanNotDo) {
  Random<6> s(5, 8, 12, 0.3, 1e3);
  s.rows[4].Sigma = 0;
  const auto before = s;
  PrimalFactors<6> factors;
  EXPECT_FALSE(primal_newton(s.rows, s.motion.inverse_mass, s.V, {}, factors));
  Random<6> hurried(5, 8, 12, 0.01, 1e3);
  EXPECT_FALSE(primal_newton(hurried.rows, hurried.motion.inverse_mass, hurried.V, {.max_sweeps = 1}, factors));
  for (const Row<6>& row : hurried.rows) EXPECT_EQ(row.lambda, 0);
  for (std::size_t b = 0; b < s.V.size(); ++b) EXPECT_EQ(s.V[b], before.V[b]);
}

}  // namespace
}  // namespace spook::primal_newton_test
