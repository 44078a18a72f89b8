#include "10_convergence/convergence.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

template <int Dof>
void warm_start(const std::vector<double>& impulses, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V) {
  // Eq. (10.2); what goes in and out, and in which units, is in convergence.hpp.
  not_implemented("10.2 warm_start", impulses, rows, V);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template void warm_start<3>(const std::vector<double>&, std::vector<Row<3>>&, std::vector<Twist<3>>&);
template void warm_start<6>(const std::vector<double>&, std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
