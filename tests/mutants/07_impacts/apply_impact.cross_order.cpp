// Wrong: takes J×r for r×J.
// Killed by: ApplyImpact.MovesBothBodies
// Says: The sign of the torque
#include "07_impacts/impacts.hpp"

namespace spook {

template <int Dof>
static Twist<Dof> generalised(const Vec3& r, const Vec3& J) {
  if constexpr (Dof == 3)
    return J;
  else
    return (Twist<6>() << J, J.cross(r)).finished();
}

template <int Dof>
void apply_impact(const Contact& contact, const Vec3& J, Motion<Dof>& motion) {
  const auto [i, j] = std::pair(contact.i, contact.j);
  motion.W[i] -= motion.inverse_mass[i].times(generalised<Dof>(contact.r_i, J));  // Eq. (7.9)
  motion.W[j] += motion.inverse_mass[j].times(generalised<Dof>(contact.r_j, J));
}

template void apply_impact<3>(const Contact&, const Vec3&, Motion<3>&);
template void apply_impact<6>(const Contact&, const Vec3&, Motion<6>&);

}  // namespace spook
