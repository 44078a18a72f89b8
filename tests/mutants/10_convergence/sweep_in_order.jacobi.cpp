// Wrong: lets no row see what those before it have done.
// Killed by: SweepInOrder.UpdatesTheRowsInThatOrder
// Says: Jacobi's iteration
#include <cmath>

#include "10_convergence/convergence.hpp"

namespace spook {

template <int Dof>
double sweep_in_order(const std::vector<int>& order, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V) {
  double largest = 0;
  const std::vector<Twist<Dof>> before = V;
  for (const int k : order) {
    std::vector<Twist<Dof>> own = before;
    const double lacked = rows[k].diagonal * std::abs(update_row(rows[k], own));
    if (std::isnan(lacked) || lacked > largest) largest = lacked;
  }
  for (const int k : order) apply_impulse(rows[k], rows[k].lambda, V);
  return largest;
}

template double sweep_in_order<3>(const std::vector<int>&, std::vector<Row<3>>&, std::vector<Twist<3>>&);
template double sweep_in_order<6>(const std::vector<int>&, std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
