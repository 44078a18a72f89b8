// Wrong: folds with std::max, which drops a NaN.
// Killed by: Residual.OfNothingIsZeroAndOfNaNIsNaN
// Says: once the largest is NaN, no later row may replace it
#include <algorithm>
#include <cmath>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

template <int Dof>
double residual(const std::vector<Row<Dof>>& rows, const std::vector<Twist<Dof>>& V) {
  double largest = 0;
  for (const Row<Dof>& row : rows) {
    // What the next update would change, in units of velocity: Eq. (4.8).
    const double r = row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]) - row.Sigma * row.lambda;
    const double next = std::clamp(row.lambda + r / row.diagonal, row.lo, row.hi);
    const double lacks = row.diagonal * std::abs(next - row.lambda);
    largest = std::max(largest, lacks);
  }
  return largest;
}

template double residual<3>(const std::vector<Row<3>>&, const std::vector<Twist<3>>&);
template double residual<6>(const std::vector<Row<6>>&, const std::vector<Twist<6>>&);

}  // namespace spook
