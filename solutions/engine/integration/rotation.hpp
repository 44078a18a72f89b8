#pragma once
// Orientation of rigid bodies: three rules for a step of (q, ω).
//
//   splitting     free_rotation: updates q and ω, keeps L = I ω up to round-off            Eq. (2.11)
//                 for three equal moments, whose ω is constant: as exponential
//   exponential   q turns by h|ω| about ω; ω does not change                               Eq. (2.6)
//   first_order   the notes' update; ω does not change                                     Eq. (2.4)
//
// With the last two rules ω changes by torques only. The gyroscopic torque, Eq. (2.9), is then added explicitly, that
// is at the old ω. It may be omitted, as in the notes:
//
//   ω += h I⁻¹ τ_gyro
#include "engine/bodies/orientations.hpp"

namespace spook {

enum class RotationUpdate { splitting, first_order, exponential };

/// The rotation rule of a world: empty for point masses.
template <int Dof>
struct RotationRule {};

template <>
struct RotationRule<6> {
  RotationUpdate update = RotationUpdate::splitting;
  bool gyroscopic_torque = true;  ///< for first_order and exponential; splitting always includes it
};

/// The change of ω by the gyroscopic torque in a step of `h` [rad/s]: zero for splitting, or if the torque is omitted.
Vec3 gyroscopic_change(const RotationRule<6>& rule, const Orientations<6>& orientations, std::size_t i,
                       const Vec3& omega, double h);

/// Updates the orientation of body i for a step of `h` [s]. For `splitting`, also updates ω.
void rotate(const RotationRule<6>& rule, Orientations<6>& orientations, std::size_t i, Vec3& omega, double h);

}  // namespace spook
