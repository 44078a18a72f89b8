#include "10_convergence/convergence.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
SolveReport relax(const Motion<Dof>& motion, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V,
                  const StopRule& stop) {
  // Eq. (10.15); what goes in and out, and in which units, is in convergence.hpp.
  not_implemented("10.9 relax", motion, rows, V, stop);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template SolveReport relax<3>(const Motion<3>&, std::vector<Row<3>>&, std::vector<Twist<3>>&, const StopRule&);
template SolveReport relax<6>(const Motion<6>&, std::vector<Row<6>>&, std::vector<Twist<6>>&, const StopRule&);

}  // namespace spook
