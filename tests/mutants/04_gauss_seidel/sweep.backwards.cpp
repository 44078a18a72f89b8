// Wrong: sweeps from the last row to the first.
// Killed by: Sweep.IsOneGaussSeidelIteration
// Says: from the last to the first
#include <algorithm>
#include <cmath>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

template <int Dof>
double sweep(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V) {
  double largest = 0;
  for (auto next = rows.rbegin(); next != rows.rend(); ++next) {
    Row<Dof>& row = *next;
    const double lacked = row.diagonal * std::abs(update_row(row, V));
    // A NaN is kept: std::max would drop it.
    if (std::isnan(lacked) || lacked > largest) largest = lacked;
  }
  return largest;
}

template double sweep<3>(std::vector<Row<3>>&, std::vector<Twist<3>>&);
template double sweep<6>(std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
