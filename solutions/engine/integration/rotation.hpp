#pragma once
// How rigid bodies turn: three rules for a step of (q, ω), and what each leaves to the torques.
//
//   splitting     free_rotation: ω turns with the body, L = I ω kept to roundings          Eq. (2.11)
//                 for a round body, whose ω does not turn with it, as exponential
//   exponential   q turns by h|ω| about ω, ω is left alone                                 Eq. (2.6)
//   first_order   the notes' update, ω is left alone                                       Eq. (2.4)
//
// Under the last two ω changes by torques only; the gyroscopic one, Eq. (2.9), is then a torque like any other, taken
// at the old ω (explicitly), and may be left out, as the notes do:
//
//   ω += h I⁻¹ τ_gyro
#include "engine/bodies/orientations.hpp"

namespace spook {

enum class RotationUpdate { splitting, first_order, exponential };

/// The rule of a world. Point masses have none.
template <int Dof>
struct RotationRule {};

template <>
struct RotationRule<6> {
  RotationUpdate update = RotationUpdate::splitting;
  bool gyroscopic_torque = true;  ///< for first_order and exponential; splitting cannot do without
};

/// What the gyroscopic torque adds to ω in a step of `h`, where the rule treats it as a torque; else zero.
Vec3 gyroscopic_change(const RotationRule<6>& rule, const Orientations<6>& orientations, std::size_t i,
                       const Vec3& omega, double h);

/// Turns body i for `h`, and for `splitting` its ω with it.
void rotate(const RotationRule<6>& rule, Orientations<6>& orientations, std::size_t i, Vec3& omega, double h);

}  // namespace spook
