// Beyond chapter 04's own tests: exchanged bodies, impulses that add up, and elimination.
#include "dense_rows.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(MakeRow, "4.1 make_row");
EXERCISE(ApplyImpulse, "4.2 apply_impulse");
EXERCISE(UpdateRow, "4.3 update_row");
EXERCISE(Residual, "4.5 residual");
EXERCISE(Solve, "4.6 solve");

struct Tangle {
  Random random;
  Motion<6> motion;
  std::vector<Constraint<6>> constraints;
  std::vector<Row<6>> rows;
  std::vector<Twist<6>> V;

  Tangle(int bodies, int count) {
    for (int k = 0; k < bodies; ++k) {
      motion.inverse_mass.push_back(random_body(random));
      motion.W.push_back(random.twist());
      motion.Wf.push_back(random.twist(0.2));
    }
    for (int k = 0; k < count; ++k) {
      const int i = random.integer(0, bodies - 1);
      const int j = (i + random.integer(1, bodies - 1)) % bodies;
      const ContactJacobian G = contact_jacobian({.i = i,
                                                  .j = j,
                                                  .n = random.unit_vector(),
                                                  .gap = 0,
                                                  .r_i = random.vector(),
                                                  .r_j = random.vector()});
      constraints.push_back({.i = i,
                             .j = j,
                             .Gi = G.Gi,
                             .Gj = G.Gj,
                             .gap = random.uniform(-0.1, 0.1),
                             .spook = {.a = random.uniform(1, 10), .b = random.uniform(0.5, 1), .Sigma = 0.5},
                             .lo = -infinity,
                             .hi = infinity});
      rows.push_back(make_row(constraints.back(), motion));
    }
    V.assign(static_cast<std::size_t>(bodies), Twist<6>::Zero());
  }
};

EXERCISE_TEST(MakeRow, IsTheSameForExchangedBodies) {
  const Tangle t(2, 1);
  const Constraint<6>& c = t.constraints[0];
  Constraint<6> other = c;
  std::swap(other.i, other.j);
  std::swap(other.Gi, other.Gj);
  const Row<6> row = make_row(c, t.motion), swapped = make_row(other, t.motion);
  expect_near("B [m/s]", "Eq. (4.4)", swapped.B, row.B, roundings(64, 10));
  expect_near("S_kk [1/kg]", "Eq. (4.3)", swapped.diagonal, row.diagonal, roundings(64, 20));
}

EXERCISE_TEST(ApplyImpulse, AddsUp) {
  Tangle t(2, 1);
  std::vector<Twist<6>> once = t.V;
  apply_impulse(t.rows[0], 0.3, t.V);
  apply_impulse(t.rows[0], -1.1, t.V);
  apply_impulse(t.rows[0], -0.8, once);
  for (std::size_t k = 0; k < 2; ++k)
    expect_near_vector("V after two impulses", "Eq. (4.5)", t.V[k], once[k], roundings(32, 10));
}

EXERCISE_TEST(UpdateRow, LeavesItsOwnRowSolved) {
  Tangle t(3, 6);
  for (Row<6>& row : t.rows) {
    update_row(row, t.V);
    const Twist<6>&V_i = t.V[static_cast<std::size_t>(row.i)], &V_j = t.V[static_cast<std::size_t>(row.j)];
    expect_near("B - Gi·V_i - Gj·V_j - Σ λ after the update [m/s]", "Eq. (4.6)",
                row.B - row.Gi.dot(V_i) - row.Gj.dot(V_j) - row.Sigma * row.lambda, 0, roundings(500, 20));
  }
}

EXERCISE_TEST(Residual, VanishesWhereEliminationEnds) {
  Tangle t(4, 8);
  const Eigen::VectorXd lambda = dense_S(t.rows).ldlt().solve(gathered(t.rows, &Row<6>::B));
  for (std::size_t k = 0; k < t.rows.size(); ++k) {
    Row<6>& row = t.rows[k];
    row.lambda = lambda[static_cast<Eigen::Index>(k)];
    t.V[static_cast<std::size_t>(row.i)] += row.lambda * row.MinvGi;
    t.V[static_cast<std::size_t>(row.j)] += row.lambda * row.MinvGj;
  }
  expect_near("residual at the solution [m/s]", "Eq. (4.8)", residual(t.rows, t.V), 0, roundings(1e4, 20));
  t.rows[3].lambda += 1;
  expect_at_least("residual away from it [m/s]", "Eq. (4.8)", residual(t.rows, t.V), 0.4,
                  "Σ = 0.5 alone makes 0.5 of it");
}

EXERCISE_TEST(Solve, AgreesWithElimination) {
  Tangle t(4, 8);
  const Eigen::MatrixXd S = dense_S(t.rows);
  const Eigen::VectorXd expected = S.ldlt().solve(gathered(t.rows, &Row<6>::B));
  const double tolerance = 1e-12;
  const SolveReport report = solve(t.rows, t.V, {.max_sweeps = 100000, .tolerance = tolerance});
  expect_true("it converges", "Eq. (4.9)", report.converged);
  // An update after row k changes its residual by S_kl Δλ_l, with S_ll |Δλ_l| below the tolerance; S has no eigenvalue
  // below Σ = 0.5.
  const double most = 8 * S.norm() / S.diagonal().minCoeff() * tolerance / 0.5;
  expect_near_vector("λ [N s]", "Eq. (4.1)", gathered(t.rows, &Row<6>::lambda), expected,
                     {most, "the tolerance, as S carries it on"});
}

}  // namespace
