#include "engine/integration/rotation.hpp"

namespace spook {

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
      if (!is_round(orientations.principal[i]))
        return free_rotation(q, omega, orientations.principal[i], h);  // Eq. (2.11)
      [[fallthrough]];  // ω of a body with three equal moments is constant, so one exact rotation suffices
    case RotationUpdate::exponential:
      q = update_exponential(q, omega, h);  // Eq. (2.6)
      return;
    case RotationUpdate::first_order:
      q = update_first_order(q, omega, h);  // Eq. (2.4)
      return;
  }
}

}  // namespace spook
