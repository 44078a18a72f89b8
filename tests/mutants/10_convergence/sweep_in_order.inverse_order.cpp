// Wrong: takes the order for the places of the rows.
// Killed by: SweepInOrder.UpdatesTheRowsInThatOrder
// Says: not at which place row 0 comes
#include <cmath>

#include "10_convergence/convergence.hpp"

namespace spook {

template <int Dof>
double sweep_in_order(const std::vector<int>& order, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V) {
  double largest = 0;
  std::vector<int> rows_at(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) rows_at[order[k]] = static_cast<int>(k);
  for (const int k : rows_at) {
    const double lacked = rows[k].diagonal * std::abs(update_row(rows[k], V));
    if (std::isnan(lacked) || lacked > largest) largest = lacked;
  }
  return largest;
}

template double sweep_in_order<3>(const std::vector<int>&, std::vector<Row<3>>&, std::vector<Twist<3>>&);
template double sweep_in_order<6>(const std::vector<int>&, std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
