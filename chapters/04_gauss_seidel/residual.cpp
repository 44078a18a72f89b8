#include "04_gauss_seidel/gauss_seidel.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
double residual(const std::vector<Row<Dof>>& rows, const std::vector<Twist<Dof>>& V) {
  // Eq. (4.8); what goes in and out, and in which units, is in gauss_seidel.hpp.
  not_implemented("4.5 residual", rows, V);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template double residual<3>(const std::vector<Row<3>>&, const std::vector<Twist<3>>&);
template double residual<6>(const std::vector<Row<6>>&, const std::vector<Twist<6>>&);

}  // namespace spook
