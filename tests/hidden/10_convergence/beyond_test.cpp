// Beyond chapter 10's own tests: orders are permutations, and solvers agree with elimination.
#include <algorithm>
#include <numeric>

#include "10_convergence/convergence.hpp"
#include "dense_rows.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(MatchContacts, "10.1 match_contacts");
EXERCISE(OrderAlong, "10.3 order_along");
EXERCISE(RandomOrder, "10.4 random_order");
EXERCISE(ObservedRate, "10.6 observed_rate");
EXERCISE(ConjugateSolve, "10.8 conjugate_solve");

EXERCISE_TEST(MatchContacts, FollowsAContactThatMoves) {
  Random random;
  std::vector<Contact> contacts;
  std::vector<OldContact> old;
  const Vec3 moved = random.vector_of_length(0.01, 0.02);
  for (int k = 0; k < 30; ++k) {
    const Vec3 r(k, 0, 0);
    contacts.push_back({.i = k % 3, .j = 3 + k % 2, .n = Vec3::UnitZ(), .gap = 0, .r_i = -r, .r_j = r});
    old.insert(old.begin(), {.i = k % 3, .j = 3 + k % 2, .point = r + moved});
  }
  const std::vector<int> found = match_contacts(contacts, old, 0.1);
  bool right = found.size() == 30;
  for (int k = 0; right && k < 30; ++k) right = found[static_cast<std::size_t>(k)] == 29 - k;
  expect_true("contact k continues the old contact 29 - k", "Eq. (10.1)", right);
}

EXERCISE_TEST(OrderAlong, SortsAnyHeights) {
  Random random;
  std::vector<double> heights(many);
  for (double& height : heights) height = random.uniform(-5, 5);
  const std::vector<int> order = order_along(heights);
  bool sorted = order.size() == heights.size() && std::is_permutation(order.begin(), order.end(),
                                                                      [] {
                                                                        std::vector<int> all(many);
                                                                        std::iota(all.begin(), all.end(), 0);
                                                                        return all;
                                                                      }()
                                                                          .begin());
  for (std::size_t k = 1; sorted && k < order.size(); ++k)
    sorted = heights[static_cast<std::size_t>(order[k - 1])] <= heights[static_cast<std::size_t>(order[k])];
  expect_true("it is an order of all rows, by height", "Eq. (10.3)", sorted);
}

EXERCISE_TEST(RandomOrder, IsAnOrderOfAllRows) {
  std::mt19937_64 generator(Random::seed());
  for (const int n : {1, 2, 17, many}) {
    std::vector<int> order = random_order(n, generator);
    std::sort(order.begin(), order.end());
    std::vector<int> all(static_cast<std::size_t>(n));
    std::iota(all.begin(), all.end(), 0);
    expect_true("each of " + std::to_string(n) + " rows is in it once", "Eq. (10.4)", order == all);
  }
}

EXERCISE_TEST(ObservedRate, FindsTheRateOfAnyDecay) {
  Random random;
  for (int k = 0; k < 20; ++k) {
    const double rate = random.uniform(0.3, 0.99);
    const int sweeps = random.integer(6, 60);
    std::vector<double> history = {random.log_uniform(1e-3, 1e3)};
    while (std::ssize(history) < sweeps) history.push_back(history.back() * rate);
    expect_near("ρ", "Eq. (10.5)", observed_rate(history), rate, roundings(100));
  }
}

EXERCISE_TEST(ConjugateSolve, AgreesWithElimination) {
  Random random;
  Motion<6> motion;
  for (int k = 0; k < 5; ++k) {
    motion.inverse_mass.push_back(random_body(random));
    motion.W.push_back(random.twist());
    motion.Wf.push_back(random.twist(0.2));
  }
  std::vector<Row<6>> rows;
  for (int k = 0; k < 12; ++k) {
    const int i = random.integer(0, 4);
    const int j = (i + random.integer(1, 4)) % 5;
    const Twist<6> Gi = random.twist(), Gj = random.twist();
    rows.push_back(make_row<6>({.i = i,
                                .j = j,
                                .Gi = Gi,
                                .Gj = Gj,
                                .gap = random.uniform(-0.1, 0.1),
                                .spook = {.a = 4, .b = 0.8, .Sigma = 0.5},
                                .lo = -infinity,
                                .hi = infinity},
                               motion));
  }
  std::vector<Twist<6>> V(5, Twist<6>::Zero());
  const Eigen::MatrixXd S = dense_S(rows);
  const Eigen::VectorXd expected = S.ldlt().solve(gathered(rows, &Row<6>::B));
  conjugate_solve(rows, V, {.max_sweeps = 200, .tolerance = 1e-12});
  // No eigenvalue of S is below Σ = 0.5, and no residual is above n S/min(S_kk) times the tolerance.
  expect_near_vector(
      "λ [N s]", "Eq. (10.8)", gathered(rows, &Row<6>::lambda), expected,
      {12 * S.norm() / S.diagonal().minCoeff() * 1e-12 / 0.5, "the tolerance, as S carries it on"});
}

}  // namespace
