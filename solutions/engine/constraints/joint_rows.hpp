#pragma once
// From joints to rows.
//
//   dg/dt = G W       G of a distance, Eq. (6.3), of a ball joint, Eq. (6.6), of what turns, Eq. (13.4), or slides, Eq. (13.6)
//   a, b, Σ           from h, k, d, Eq. (3.4)-(3.6); of a motor 0, 1, 1/(h c), Eq. (13.12)
//   -∞ < λ < ∞        what holds
//   0 <= λ < ∞        a limit; without room, λ = 0, where it is out of reach
//   -h T <= λ <= h T  a motor
#include <vector>

#include "engine/constraints/joints.hpp"

namespace spook {

/// Adds the rows of each joint in turn: one of a distance, three of a ball joint, five or six of a hinge, slider or weld,
/// then those of its limits and its motor. All that a world fills in must be given.
template <int Dof>
void add_joint_rows(const std::vector<Joint>& joints, double h, const Bodies<Dof>& bodies,
                    std::vector<Row<Dof>>& rows);

}  // namespace spook
