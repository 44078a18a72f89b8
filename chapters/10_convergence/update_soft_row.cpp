#include "10_convergence/convergence.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
double update_soft_row(double h, const SoftParameters& soft, double gap, Row<Dof>& row,
                       std::vector<Twist<Dof>>& W) {
  // Eq. (10.21), (4.7); what goes in and out, and in which units, is in convergence.hpp.
  not_implemented("10.11 update_soft_row", h, soft, gap, row, W);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template double update_soft_row<3>(double, const SoftParameters&, double, Row<3>&, std::vector<Twist<3>>&);
template double update_soft_row<6>(double, const SoftParameters&, double, Row<6>&, std::vector<Twist<6>>&);

}  // namespace spook
