#pragma once
// Rows of joints.
//
//   dg/dt = G W       G of a distance, Eq. (6.3); a ball joint, Eq. (6.6); angles, Eq. (13.4); shifts, Eq. (13.6)
//   a, b, Σ           from h, k, d, Eq. (3.4)-(3.6); for a motor 0, 1, 1/(h c), Eq. (13.12)
//   -∞ < λ < ∞        holding rows, and springs
//   0 <= λ < ∞        a limit, or a rope; bounds of 0 while out of reach
//   -h T <= λ <= h T  a motor
// A spring k with a damper c, of a coordinate s that was s_0 at rest, with u = G W before and u' after the step:
//
//   λ = -h k (s - s_0) - P u' + Q u
//   P = ¼h²k + ½h c, Q = ¼h²k - ½h c      where the step resolves the spring and the damper
//   a, b, Σ = h k/P, 1 - Q/P, 1/P
//
// So the spring acts at the mean of three positions, as SPOOK's own rows with d = 0 do, and the damper at the mean of
// two speeds: the order is two. Both parts of Q are at most the inertia m = 1/(G M⁻¹Gᵀ), and any excess acts at the
// end of the step:
//
//   P = h²k + h c - 3 min(¼h²k, m) - min(½h c, m),  Q = min(¼h²k, m) - min(½h c, m)
//
// Then P >= |Q| and P + Q >= h²k - 2m, so that a step is stable for any k and c. A spring or damper that the step does
// not resolve comes to rest within a few steps, and does not change its sign in each.
#include <vector>

#include "engine/constraints/joints.hpp"

namespace spook {

/// Adds the rows of each joint in turn: one for a distance, three for a ball joint, five or six for a hinge, slider or
/// weld, then the rows of its limit, its spring and its motor. Defaults of the joints must be filled in, as a world
/// does. The relaxation of joints without a k of their own is at least `least_d` [steps].
template <int Dof>
void add_joint_rows(const std::vector<Joint>& joints, double h, const Bodies<Dof>& bodies,
                    std::vector<Row<Dof>>& rows, double least_d = 0);

/// Tells whether a joint's limits change the speed that its motor aims at, at the free coordinate `value`, Eq. (13.17).
bool limits_motor(const Joint& joint, double value, double h);

/// Returns the speed that a motor aims at in the second solve, Eq. (7.17), after which no speed of a return is left:
/// its own, but 0 towards an exceeded limit.
double speed_without_return(const Joint& joint, double value, double h);

/// Returns the part of the motor row's λ that is the limit's [N s or N m s]: 0 unless Eq. (13.17) has changed the speed
/// of this row. Then the motor's part is that of Eq. (13.12) and (13.13) with its own desired speed, and the limit has
/// the remainder. `speed`: G W at the end of the step. 0 for a motor of infinite strength, whose part would be
/// infinite.
double impulse_of_limit(const Joint& joint, const Row<6>& motor_row, double speed, const Bodies<6>& bodies,
                        double h);

}  // namespace spook
