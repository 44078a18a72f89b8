// Wrong: begins at the end of the order.
// Killed by: SweepInOrder.UpdatesTheRowsInThatOrder
// Says: the order backwards
#include <cmath>

#include "10_convergence/convergence.hpp"

namespace spook {

template <int Dof>
double sweep_in_order(const std::vector<int>& order, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V) {
  double largest = 0;
  for (std::size_t n = order.size(); n-- > 0;) {
    const int k = order[n];
    const double lacked = rows[k].diagonal * std::abs(update_row(rows[k], V));
    if (std::isnan(lacked) || lacked > largest) largest = lacked;
  }
  return largest;
}

template double sweep_in_order<3>(const std::vector<int>&, std::vector<Row<3>>&, std::vector<Twist<3>>&);
template double sweep_in_order<6>(const std::vector<int>&, std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
