#pragma once
// Joints that recover: they correct their positions in this step, which must leave the bodies no speed.
//
// A joint beyond its limit moves back, and a rope that is too long shortens. Rows that hold a joint should do no work,
// since its points do not move apart. If a step is too long, as when a chain snaps taut, they do work: they close the
// gap that the step has left, at a speed. The work of a row λ in a step, with its rates u₀ = G W before and u₁ = G (W +
// W_f + V) after it, is
//
//   λ (u₀ + u₁)/2  [J]                                                                                    Eq. (13.19)
//
// It is summed over each mechanism: the bodies that joints connect, directly or by way of others.
//
// Recovery moves a gap g to (1 - a h) g, and leaves no speed that would bring it back. With the default d = 1/4 a h is
// 2, so g would change its sign in each step for ever. Therefore the next step of such a mechanism has a relaxation of
// at least 3/4: then a h = 4/(1 + 4 d) = 1, Eq. (3.4), and the gap closes.
#include <optional>
#include <vector>

#include "engine/constraints/joints.hpp"

namespace spook {

/// Relaxation that closes a gap in one step if it leaves no speed [steps].
inline constexpr double closing_relaxation = 0.75;

/// The row of a motor whose speed its limits have changed, and its speed where a return leaves none [m/s or rad/s].
struct LimitedMotor {
  std::size_t row;
  double speed;
};

/// The row of a joint's limit, or of a rope, that is no spring.
struct RigidLimit {
  std::size_t row;
  double ignored;  ///< it recovers if it opens faster [m/s or rad/s]
  std::optional<LimitedMotor> motor = {};
};

/// The rows of joints that may recover.
struct JointRecovery {
  std::vector<RigidLimit> limits = {};
  std::vector<std::size_t> holding = {};  ///< rows that hold joints, and have done work
};

/// Returns the rows of limits and ropes without a k of their own. A row that opens in a step by less than 1e-9 of its
/// range, or by less than 1e-9 rad, does not recover. A taut rope that swings at a speed v leaves its circle by v²
/// h²/(2 l) in each step, and opens at v² h/(2 l) to come back to it: that is no recovery. At the turning point of the
/// swing v is 0. There the rope still opens at less than |gravity| h/100, which is ignored, too. `first_rows`: the
/// first row of each joint.
template <int Dof>
std::vector<RigidLimit> rigid_limits(const std::vector<Joint>& joints,
                                     const std::vector<std::size_t>& first_rows, const Bodies<Dof>& bodies,
                                     const Vec3& gravity, double h);

/// Returns the rows that hold joints without a k of their own, of each mechanism in which their work is more than a
/// hundredth of each of three kinetic energies: before the step, after it, and by forces alone from rest. Leaves out a
/// mechanism with a gap of more than a twentieth of an arm, or 0.05 rad: such a gap is not left by a step, but comes
/// from a joint that did not fit its bodies. `rows` are solved, and `V` is their change of velocities.
template <int Dof>
std::vector<std::size_t> holding_rows_with_work(const std::vector<Joint>& joints,
                                                const std::vector<std::size_t>& first_rows,
                                                const std::vector<Row<Dof>>& rows, const Bodies<Dof>& bodies,
                                                const std::vector<Twist<Dof>>& V);

}  // namespace spook
