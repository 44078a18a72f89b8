#include "04_gauss_seidel/gauss_seidel.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
double update_row(Row<Dof>& row, std::vector<Twist<Dof>>& V) {
  // Eq. (4.6), (4.7); what goes in and out, and in which units, is in gauss_seidel.hpp.
  not_implemented("4.3 update_row", row, V);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template double update_row<3>(Row<3>&, std::vector<Twist<3>>&);
template double update_row<6>(Row<6>&, std::vector<Twist<6>>&);

}  // namespace spook
