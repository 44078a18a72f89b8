#pragma once
// Joints that recover: those which have pushed their bodies together, and must not leave them a speed.
//
// A joint beyond its limit moves back, and a rope that is too long shortens. Rows that hold a joint do no work, since its
// points do not move apart. If a step is long beside what happens in it, as when a chain snaps taut, they do: they close
// the gap that the step has left, with a speed. The work of a row λ in a step, with its rates u₀ = G W before and
// u₁ = G (W + W_f + V) after it, is
//
//   λ (u₀ + u₁)/2  [J]                                                                                    Eq. (13.19)
//
// It is summed over each mechanism: the bodies that joints connect, directly or by way of others.
#include <vector>

#include "engine/constraints/joints.hpp"

namespace spook {

/// The row of a joint's limit, or of a rope, that is no spring.
struct RigidLimit {
  std::size_t row;
  double ignored;  ///< it recovers if it opens faster [m/s or rad/s]
};

/// The rows of joints that may recover.
struct JointRecovery {
  std::vector<RigidLimit> limits = {};
  std::vector<std::size_t> holding = {};  ///< rows that hold joints, and have done work
};

/// Returns the rows of limits and ropes without a k of their own. A step in which one opens by less than 1e-9 of its
/// range, or than 1e-9 rad, does not count. A taut rope that swings at a speed v leaves its circle by v² h²/(2 l) in
/// each step, and opens at v² h/(2 l) to come back to it: that is no recovery. Where it turns, v is 0, and what it opens
/// from the steps before is less than a hundredth of |gravity| h. `first_rows`: the first row of each joint.
template <int Dof>
std::vector<RigidLimit> rigid_limits(const std::vector<Joint>& joints,
                                     const std::vector<std::size_t>& first_rows, const Bodies<Dof>& bodies,
                                     const Vec3& gravity, double h);

/// Returns the rows that hold joints without a k of their own, of each mechanism in which their work is more than a
/// hundredth of three kinetic energies: before the step, after it, and that which forces alone would give it at rest.
/// Leaves out a mechanism with a gap of more than a twentieth of an arm, or rad. No step has left such a gap: a joint did
/// not fit its bodies, and is pulled together. `rows` are solved, and `V` is their change of velocities.
template <int Dof>
std::vector<std::size_t> holding_rows_with_work(const std::vector<Joint>& joints,
                                                const std::vector<std::size_t>& first_rows,
                                                const std::vector<Row<Dof>>& rows, const Bodies<Dof>& bodies,
                                                const std::vector<Twist<Dof>>& V);

}  // namespace spook
