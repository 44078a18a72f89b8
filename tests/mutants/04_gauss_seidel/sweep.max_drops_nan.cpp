// Wrong: folds with std::max, which drops a NaN.
// Killed by: Sweep.DoesNotHideANaN
// Says: once the largest is NaN, no later row may replace it
#include <algorithm>
#include <cmath>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

template <int Dof>
double sweep(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V) {
  double largest = 0;
  for (Row<Dof>& row : rows) {
    const double lacked = row.diagonal * std::abs(update_row(row, V));
    // A NaN is kept: std::max would drop it.
    largest = std::max(largest, lacked);
  }
  return largest;
}

template double sweep<3>(std::vector<Row<3>>&, std::vector<Twist<3>>&);
template double sweep<6>(std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
