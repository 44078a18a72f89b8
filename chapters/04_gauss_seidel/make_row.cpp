#include "04_gauss_seidel/gauss_seidel.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
Row<Dof> make_row(const Constraint<Dof>& constraint, const Motion<Dof>& motion) {
  // Eq. (4.3), (4.4); what goes in and out, and in which units, is in gauss_seidel.hpp.
  not_implemented("4.1 make_row", constraint, motion);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template Row<3> make_row<3>(const Constraint<3>&, const Motion<3>&);
template Row<6> make_row<6>(const Constraint<6>&, const Motion<6>&);

}  // namespace spook
