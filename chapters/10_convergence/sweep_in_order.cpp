#include "10_convergence/convergence.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
double sweep_in_order(const std::vector<int>& order, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V) {
  // Eq. (4.9); what goes in and out, and in which units, is in convergence.hpp.
  not_implemented("10.5 sweep_in_order", order, rows, V);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template double sweep_in_order<3>(const std::vector<int>&, std::vector<Row<3>>&, std::vector<Twist<3>>&);
template double sweep_in_order<6>(const std::vector<int>&, std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
