#include "problems.hpp"

#include <stdexcept>

namespace spook::testing {

namespace {

enum State { at_lo, free_row, at_hi };

// λ with the free rows solved and the others at their bounds; false when it is not the solution.
bool solves(const Eigen::MatrixXd& S, const Eigen::VectorXd& B, const Eigen::VectorXd& lo,
            const Eigen::VectorXd& hi, const std::vector<State>& states, Eigen::VectorXd& lambda) {
  const auto n = B.size();
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd right = B;
  for (Eigen::Index k = 0; k < n; ++k) {
    const State state = states[static_cast<std::size_t>(k)];
    if (state == free_row) A.row(k) = S.row(k);
    if (state == at_lo) right[k] = lo[k];
    if (state == at_hi) right[k] = hi[k];
  }
  if (!right.allFinite()) return false;
  lambda = A.partialPivLu().solve(right);
  const Eigen::VectorXd lacking = B - S * lambda;
  const double slack = 1e-12 * (1 + B.norm());
  for (Eigen::Index k = 0; k < n; ++k) {
    const State state = states[static_cast<std::size_t>(k)];
    if (lambda[k] < lo[k] - slack || lambda[k] > hi[k] + slack) return false;
    if (state == at_lo && lacking[k] > slack) return false;
    if (state == at_hi && lacking[k] < -slack) return false;
  }
  return true;
}

}  // namespace

Eigen::VectorXd enumerate_solution(const Eigen::MatrixXd& S, const Eigen::VectorXd& B,
                                   const Eigen::VectorXd& lo, const Eigen::VectorXd& hi) {
  const auto n = static_cast<std::size_t>(B.size());
  std::vector<State> states(n, at_lo);
  Eigen::VectorXd lambda;
  for (;;) {
    if (solves(S, B, lo, hi, states, lambda)) return lambda;
    std::size_t k = 0;
    while (k < n && states[k] == at_hi) states[k++] = at_lo;
    if (k == n) throw std::logic_error("no set of active bounds solves the problem");
    states[k] = static_cast<State>(states[k] + 1);
  }
}

}  // namespace spook::testing
