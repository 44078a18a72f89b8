// Wrong: goes over the rows there and back.
// Killed by: Sweep.IsOneGaussSeidelIteration
// Says: went over the rows there and back
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
    if (std::isnan(lacked) || lacked > largest) largest = lacked;
  }
  for (auto next = rows.rbegin(); next != rows.rend(); ++next) update_row(*next, V);
  return largest;
}

template double sweep<3>(std::vector<Row<3>>&, std::vector<Twist<3>>&);
template double sweep<6>(std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
