#include "methods/methods.hpp"

namespace spook::plots {

double factor_work(const Factors& factors) {
  const SparseMatrix& L = factors.ldlt.matrixL().nestedExpression();  // without its diagonal of ones
  double sum = 0;
  for (int k = 0; k < L.cols(); ++k) {
    const double below = L.outerIndexPtr()[k + 1] - L.outerIndexPtr()[k];
    sum += below * (below + 3) / 2;
  }
  return sum;
}

double solve_work(const Factors& factors) {
  const SparseMatrix& L = factors.ldlt.matrixL().nestedExpression();
  return 2.0 * static_cast<double>(L.nonZeros()) + static_cast<double>(L.cols());
}

}  // namespace spook::plots
