#include "09_better_friction/better_friction.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
double residual_on_cones(const std::vector<FrictionContact>& contacts, const std::vector<Row<Dof>>& rows,
                         const std::vector<Twist<Dof>>& V) {
  // Eq. (9.7); what goes in and out, and in which units, is in better_friction.hpp.
  not_implemented("9.7 residual_on_cones", contacts, rows, V);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template double residual_on_cones<3>(const std::vector<FrictionContact>&, const std::vector<Row<3>>&,
                                     const std::vector<Twist<3>>&);
template double residual_on_cones<6>(const std::vector<FrictionContact>&, const std::vector<Row<6>>&,
                                     const std::vector<Twist<6>>&);

}  // namespace spook
