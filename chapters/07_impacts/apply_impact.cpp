#include "07_impacts/impacts.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
void apply_impact(const Contact& contact, const Vec3& J, Motion<Dof>& motion) {
  // Eq. (7.9); what goes in and out, and in which units, is in impacts.hpp.
  not_implemented("7.7 apply_impact", contact, J, motion);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template void apply_impact<3>(const Contact&, const Vec3&, Motion<3>&);
template void apply_impact<6>(const Contact&, const Vec3&, Motion<6>&);

}  // namespace spook
