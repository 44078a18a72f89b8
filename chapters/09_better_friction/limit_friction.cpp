#include "09_better_friction/better_friction.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
void limit_friction(const std::vector<FrictionContact>& contacts, std::vector<Row<Dof>>& rows) {
  // Eq. (9.1); what goes in and out, and in which units, is in better_friction.hpp.
  not_implemented("9.2 limit_friction", contacts, rows);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template void limit_friction<3>(const std::vector<FrictionContact>&, std::vector<Row<3>>&);
template void limit_friction<6>(const std::vector<FrictionContact>&, std::vector<Row<6>>&);

}  // namespace spook
