#include "dense_rows.hpp"

#include <stdexcept>

#include "algebra.hpp"

namespace spook::testing {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

enum State { at_lo, free_row, at_hi };

// Solves for the free rows with the others at their bounds. Returns false if the result is not the solution.
bool solves(const Bounded& problem, const std::vector<State>& states, VectorXd& lambda) {
  const auto n = problem.B.size();
  MatrixXd A = MatrixXd::Identity(n, n);
  VectorXd right = problem.B;
  for (Eigen::Index k = 0; k < n; ++k) {
    const State state = states[k];
    if (state == free_row) A.row(k) = problem.S.row(k);
    if (state == at_lo) right[k] = problem.lo[k];
    if (state == at_hi) right[k] = problem.hi[k];
  }
  if (!right.allFinite()) return false;
  lambda = A.partialPivLu().solve(right);
  const VectorXd lacking = problem.B - problem.S * lambda;
  const double slack = 1e-12 * (1 + problem.B.norm());
  for (Eigen::Index k = 0; k < n; ++k) {
    const State state = states[k];
    if (lambda[k] < problem.lo[k] - slack || lambda[k] > problem.hi[k] + slack) return false;
    if (state == at_lo && lacking[k] > slack) return false;
    if (state == at_hi && lacking[k] < -slack) return false;
  }
  return true;
}

}  // namespace

VectorXd enumerate_solution(const Bounded& problem) {
  const std::size_t n = static_cast<std::size_t>(problem.B.size());
  std::vector<State> states(n, at_lo);
  VectorXd lambda;
  for (;;) {
    if (solves(problem, states, lambda)) return lambda;
    std::size_t k = 0;
    while (k < n && states[k] == at_hi) states[k++] = at_lo;
    if (k == n) throw std::logic_error("no set of active bounds solves the problem");
    states[k] = static_cast<State>(states[k] + 1);
  }
}

double condition(const MatrixXd& S) {
  const VectorXd found = eigenvalues(S);
  return (1 + found.maxCoeff()) / found.minCoeff();
}

}  // namespace spook::testing
