// Dense factors of a few rows: the solution of sparse ones, or none and no change.
#include "engine/solvers/small_direct.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "raw_system.hpp"
#include "refusals.hpp"

namespace spook::small_direct_test {
namespace {

/// A chain of bodies of masses from e⁻³ to e³, the first of which is static, with rows between neighbours.
template <int Dof>
struct Chain : RandomSystem<Dof> {
  Chain(unsigned seed, int bodies, int count, double bound = infinity) : RandomSystem<Dof>(seed) {
    this->add_light_and_heavy(bodies, 1);
    for (int k = 0; k < count; ++k) {
      const int i = k % (bodies - 1);
      this->add_row(i, i + 1, spook_parameters(this->h, 1e9, 3), -bound, bound);
    }
  }
};

template <int Dof>
void expect_what_sparse_factors_find(unsigned seed, int rows) {
  // A row a body: well conditioned except for the masses, of which the ratio is at most e⁶ ≈ 400. Their square times ε,
  // ten times that for so many rows and two orders of summation, is 3.5e-10; nearly all are below 1e-13.
  Chain<Dof> dense(seed, rows + 1, rows), sparse = dense;
  Factors factors;
  const SolveReport theirs = direct_solve(sparse.rows, sparse.V, {.tolerance = 0}, factors);
  const auto ours = small_direct(dense.rows, dense.V, {.tolerance = 0});
  ASSERT_TRUE(ours) << "seed " << seed << ", rows " << rows;
  EXPECT_TRUE(ours->converged);
  EXPECT_EQ(ours->history.size(), 1U);
  EXPECT_EQ(theirs.history.size(), 1U);
  EXPECT_LT(difference(dense.rows, sparse.rows), 3.5e-10) << "seed " << seed << ", rows " << rows;
  std::vector<Twist<Dof>> V(dense.V.size(), Twist<Dof>::Zero());
  for (const Row<Dof>& row : dense.rows) apply_impulse(row, row.lambda, V);
  for (std::size_t b = 0; b < V.size(); ++b)
    EXPECT_LT((V[b] - dense.V[b]).norm(), 1e-13 * (1 + V[b].norm())) << "seed " << seed << ", body " << b;
}

TEST(SmallDirect, FindsWhatSparseFactorsFind) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    expect_what_sparse_factors_find<3>(seed, 1 + static_cast<int>(seed) % most_dense_rows);
    expect_what_sparse_factors_find<6>(seed, 1 + static_cast<int>(seed) % most_dense_rows);
  }
}

TEST(SmallDirect, SolvesRowsThatShareBothBodies) {
  // Three rows between the same two, in either order of the bodies: a point held in space.
  Chain<3> dense(3, 2, 3), sparse = dense;
  for (Chain<3>* s : {&dense, &sparse}) {
    std::swap(s->rows[1].i, s->rows[1].j), std::swap(s->rows[1].Gi, s->rows[1].Gj);
    std::swap(s->rows[1].MinvGi, s->rows[1].MinvGj);
  }
  Factors factors;
  direct_solve(sparse.rows, sparse.V, {}, factors);
  ASSERT_TRUE(small_direct(dense.rows, dense.V, {}));
  EXPECT_LT(difference(dense.rows, sparse.rows), 1e-11);
}

TEST(SmallDirect, AcceptsFewerRowsOnFewVelocities) {
  // Two dynamic bodies have six velocities.
  Chain<3> few(5, 3, most_dense_rows_on_bodies, 1e12), many(5, 3, most_dense_rows_on_bodies + 1, 1e12);
  EXPECT_TRUE(small_direct(few.rows, few.V, {}));
  EXPECT_FALSE(small_direct(many.rows, many.V, {}));
  Chain<3> longer(5, most_dense_rows_on_bodies + 2, most_dense_rows_on_bodies + 1, 1e12);
  EXPECT_TRUE(small_direct(longer.rows, longer.V, {}));
}

/// There is no solution, and no change.
void expect_nothing(Chain<3> s, const char* why, const StopRule& stop = {}) {
  const Chain<3> before = s;
  EXPECT_FALSE(small_direct(s.rows, s.V, stop)) << why;
  for (std::size_t k = 0; k < s.rows.size(); ++k) EXPECT_EQ(s.rows[k].lambda, before.rows[k].lambda) << why;
  EXPECT_EQ(s.V, before.V) << why;
}

TEST(SmallDirect, ReturnsNothingForUnsuitableRows) {
  expect_nothing(Chain<3>(1, 2, 0), "no rows");
  expect_nothing(Chain<3>(1, 50, most_dense_rows + 1), "too many");
  expect_nothing(Chain<3>(1, 4, 3, 0), "no room");
  expect_nothing(Chain<3>(1, 4, 3, 1e-9), "bounds that are active");
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Chain<3> twice(seed, 3, 1);
    twice.rows.front().Sigma = 0;
    twice.rows.push_back(twice.rows.front());
    Row<3>& second = twice.rows.back();
    for (Twist<3>* block : {&second.Gi, &second.Gj, &second.MinvGi, &second.MinvGj}) *block *= 0.7;
    second.B *= 0.7;
    expect_nothing(twice, "an equal row, Σ = 0: a pivot of round-off");
  }
  Chain<3> bad(1, 4, 3);
  bad.rows[1].B = std::numeric_limits<double>::quiet_NaN();
  expect_nothing(bad, "a B of NaN");
  bad = Chain<3>(1, 4, 3);
  bad.rows[1].B = infinity;
  expect_nothing(bad, "an infinite B");
}

TEST(SmallDirect, RefusesWhatSolveRefuses) {
  Chain<3> s(1, 4, 3);
  expect_refusal({"max_sweeps", "0"}, [&] { small_direct(s.rows, s.V, {.max_sweeps = 0}); });
  expect_refusal({"tolerance", "-1"}, [&] { small_direct(s.rows, s.V, {.tolerance = -1}); });
}

}  // namespace
}  // namespace spook::small_direct_test
