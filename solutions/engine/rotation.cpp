#include "engine/rotation.hpp"

namespace spook {

Mat3 Orientations<6>::inverse_inertia(std::size_t i) const {
  return world_inertia(q[i], inverse_principal[i]);
}

Vec3 gyroscopic_change(const RotationRule<6>& rule, const Orientations<6>& orientations, std::size_t i,
                       const Vec3& omega, double h) {
  if (rule.update == RotationUpdate::splitting || !rule.gyroscopic_torque) return Vec3::Zero();
  const Mat3 inertia = world_inertia(orientations.q[i], orientations.principal[i]);
  return h * orientations.inverse_inertia(i) * gyroscopic_torque(inertia, omega);  // Eq. (2.9)
}

void rotate(const RotationRule<6>& rule, Orientations<6>& orientations, std::size_t i, Vec3& omega, double h) {
  Quat& q = orientations.q[i];
  switch (rule.update) {
    case RotationUpdate::splitting:
      return free_rotation(q, omega, orientations.principal[i], h);  // Eq. (2.11)
    case RotationUpdate::first_order:
      q = update_first_order(q, omega, h);  // Eq. (2.4)
      return;
    case RotationUpdate::exponential:
      q = update_exponential(q, omega, h);  // Eq. (2.6)
      return;
  }
}

}  // namespace spook
