#include "14_fast_rows/fast_rows.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
double update_contact(const FrictionContact& contact, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V) {
  // Eq. (14.1), (14.2); what goes in and out, and in which units, is in fast_rows.hpp.
  not_implemented("14.2 update_contact", contact, rows, V);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template double update_contact<3>(const FrictionContact&, std::vector<Row<3>>&, std::vector<Twist<3>>&);
template double update_contact<6>(const FrictionContact&, std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
