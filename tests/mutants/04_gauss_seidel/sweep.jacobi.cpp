// Wrong: shows every row the velocities of before the sweep: Jacobi.
// Killed by: Sweep.IsOneGaussSeidelIteration
// Says: This is Jacobi's iteration
#include <algorithm>
#include <cmath>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

template <int Dof>
double sweep(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V) {
  double largest = 0;
  const std::vector<Twist<Dof>> old = V;
  for (Row<Dof>& row : rows) {
    std::vector<Twist<Dof>> seen = old;
    const double delta = update_row(row, seen);
    apply_impulse(row, delta, V);
    const double lacked = row.diagonal * std::abs(delta);
    // A NaN is kept: std::max would drop it.
    if (std::isnan(lacked) || lacked > largest) largest = lacked;
  }
  return largest;
}

template double sweep<3>(std::vector<Row<3>>&, std::vector<Twist<3>>&);
template double sweep<6>(std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
