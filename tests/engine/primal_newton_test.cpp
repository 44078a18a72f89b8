// Factors on bodies: the same solution as chapter 11's on rows, with any bounds.
#include "engine/solvers/primal_newton.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/solvers/primal_interior_point.hpp"
#include "engine/world/world.hpp"
#include "raw_system.hpp"

namespace spook::primal_newton_test {
namespace {

constexpr double h = 1.0 / 60;

/// Rows between random bodies of a random net, some of which are static.
template <int Dof>
struct Net : RandomSystem<Dof> {
  /// `rub` bounds two of three rows; Σ is that of a contact, and of friction with `viscosity`.
  Net(unsigned seed, int bodies, int contacts, double rub, double viscosity) : RandomSystem<Dof>(seed) {
    for (int b = 0; b < bodies; ++b) {
      InverseMass<Dof> inverse{};
      inverse.linear = b % 5 == 0 ? 0 : std::exp(2 * this->uniform());
      if constexpr (Dof == 6)
        if (inverse.linear > 0) {
          Mat3 root = Mat3::Identity();
          for (double& entry : root.reshaped()) entry += 0.3 * this->uniform();
          inverse.angular = inverse.linear * root * root.transpose();
        }
      this->add_body(inverse);
    }
    this->V.assign(this->motion.W.size(), Twist<Dof>::Zero());
    for (int c = 0; c < contacts; ++c) {
      const int i = this->index(bodies), j = (i + 1 + this->index(bodies - 1)) % bodies;
      if (i % 5 == 0 && j % 5 == 0) continue;
      this->add_row(i, j, spook_parameters(h, 1e6, 3), 0, infinity);
      for (int tangent = 0; tangent < 2; ++tangent)
        this->add_row(i, j, friction_parameters(h, viscosity), -rub, rub);
    }
  }
};

template <int Dof>
void expect_answers_of_rows() {
  for (unsigned seed = 1; seed <= 30; ++seed)
    for (const double rub : {infinity, 0.3, 0.01}) {
      Net<Dof> on_bodies(seed, seed % 2 == 0 ? 8 : 5, 20, rub, 1e3);  // 36 or 24 velocities, where Dof is 6
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
      EXPECT_LE(difference(on_bodies.rows, on_rows.rows), 1e-9) << "seed " << seed << ", rub " << rub;
      std::vector<Twist<Dof>> V(on_bodies.V.size(), Twist<Dof>::Zero());
      for (const Row<Dof>& row : on_bodies.rows) apply_impulse(row, row.lambda, V);
      for (std::size_t b = 0; b < V.size(); ++b) EXPECT_LE((V[b] - on_bodies.V[b]).norm(), 1e-11);
    }
}

TEST(PrimalNewton, HasTheAnswersOfRows) {
  expect_answers_of_rows<3>();
  expect_answers_of_rows<6>();
}

TEST(PrimalNewton, FromItsOwnAnswerTakesOneFactorisation) {
  Net<6> s(7, 8, 20, 0.3, 1e3);
  PrimalFactors<6> factors;
  ASSERT_TRUE(primal_newton(s.rows, s.motion.inverse_mass, s.V, {}, factors));
  const auto again = primal_newton(s.rows, s.motion.inverse_mass, s.V, {}, factors);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->history.size(), 1U);
  EXPECT_EQ(factors.factors.analyses(), 1) << "the pattern is that of the bodies, whichever rows are held";
}

TEST(PrimalNewton, AStackAtRestTakesOneFactorisationAStep) {
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

TEST(PrimalNewton, RefinesWhatASmallSigmaLeaves) {
  // Σ = 1/(h c) = 6e-11: λ = Σ⁻¹ (B - G V) has lost ten digits when it is first computed.
  Net<6> s(3, 8, 12, infinity, 1e12);
  PrimalFactors<6> factors;
  const auto report = primal_newton(s.rows, s.motion.inverse_mass, s.V, {}, factors);
  ASSERT_TRUE(report);
  // Without refinement the residual would be about 1e-6 of B; Eq. (11.13) allows far less.
  EXPECT_LE(residual(s.rows, s.V), roundings(s.rows));
  EXPECT_LT(roundings(s.rows), 1e-10);
}

/// Solves by primal_interior_point alone, which primal_newton calls only if Newton's method makes no progress.
template <int Dof>
SolveReport by_interior_point(Net<Dof>& s) {
  VelocitySystem<Dof> on(s.rows, s.motion.inverse_mass);
  VelocityFactors factors;
  return primal_interior_point(s.rows, on, s.V, {}, factors);
}

template <int Dof>
void expect_interior_point_has_answers_of_rows() {
  for (unsigned seed = 1; seed <= 30; ++seed)
    for (const double rub : {infinity, 0.3, 0.01}) {
      Net<Dof> on_bodies(seed, 8, 20, rub, 1e3);
      on_bodies.rows[3].lo = on_bodies.rows[3].hi = 0.05;  // one that has no room
      auto on_rows = on_bodies;
      ASSERT_TRUE(by_interior_point(on_bodies).converged) << "seed " << seed << ", rub " << rub;
      Factors factors;
      ASSERT_TRUE(direct_solve(on_rows.rows, on_rows.V, {}, factors).converged);
      EXPECT_LE(difference(on_bodies.rows, on_rows.rows), 1e-9)
          << "seed " << seed << ", rub " << rub;  // as above
      for (std::size_t b = 0; b < on_rows.V.size(); ++b)
        EXPECT_LE((on_bodies.V[b] - on_rows.V[b]).norm(), 1e-9 * (1 + on_rows.V[b].norm()));
    }
}

TEST(PrimalInteriorPoint, HasTheAnswersOfRows) {
  expect_interior_point_has_answers_of_rows<3>();
  expect_interior_point_has_answers_of_rows<6>();
}

TEST(PrimalNewton, SolvesFrictionThatIsMoreThanEnough) {
  // A hundred rows on six dynamic bodies, with Σ = 6e-11 of friction. The active set hardly changes the energy, and
  // Newton's method on the free rows never settles.
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Net<6> s(seed, 8, 40, 0.1, 1e12);
    PrimalFactors<6> factors;
    const auto report = primal_newton(s.rows, s.motion.inverse_mass, s.V, {}, factors);
    ASSERT_TRUE(report) << "seed " << seed;
    EXPECT_TRUE(report->converged);
    EXPECT_LE(residual(s.rows, s.V), 1e-12) << "seed " << seed;
  }
}

TEST(PrimalNewton, ReturnsNothingForUnsuitableRows) {
  Net<6> s(5, 8, 12, 0.3, 1e3);
  s.rows[4].Sigma = 0;
  const auto before = s;
  PrimalFactors<6> factors;
  EXPECT_FALSE(primal_newton(s.rows, s.motion.inverse_mass, s.V, {}, factors));
  Net<6> hurried(5, 8, 12, 0.01, 1e3);
  EXPECT_FALSE(primal_newton(hurried.rows, hurried.motion.inverse_mass, hurried.V, {.max_sweeps = 1}, factors));
  for (const Row<6>& row : hurried.rows) EXPECT_EQ(row.lambda, 0);
  for (std::size_t b = 0; b < s.V.size(); ++b) EXPECT_EQ(s.V[b], before.V[b]);
}

}  // namespace
}  // namespace spook::primal_newton_test
