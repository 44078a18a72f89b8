#include "14_fast_rows/fast_rows.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
double update_pack(Pack<Dof>& pack, std::vector<Twist<Dof>>& V) {
  // Eq. (14.9), (4.6), (4.7); what goes in and out, and in which units, is in fast_rows.hpp.
  not_implemented("14.4 update_pack", pack, V);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template double update_pack<3>(Pack<3>&, std::vector<Twist<3>>&);
template double update_pack<6>(Pack<6>&, std::vector<Twist<6>>&);

}  // namespace spook
