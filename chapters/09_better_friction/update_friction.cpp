#include "09_better_friction/better_friction.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
double update_friction(const FrictionContact& contact, std::vector<Row<Dof>>& rows,
                       std::vector<Twist<Dof>>& V) {
  // Eq. (9.5), (9.6); what goes in and out, and in which units, is in better_friction.hpp.
  not_implemented("9.5 update_friction", contact, rows, V);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template double update_friction<3>(const FrictionContact&, std::vector<Row<3>>&, std::vector<Twist<3>>&);
template double update_friction<6>(const FrictionContact&, std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
