#pragma once
// Rows of joints.
//
//   dg/dt = G W       G of a distance, Eq. (6.3); a ball joint, Eq. (6.6); angles, Eq. (13.4); shifts, Eq. (13.6)
//   a, b, Σ           from h, k, d, Eq. (3.4)-(3.6); for a motor 0, 1, 1/(h c), Eq. (13.12)
//   -∞ < λ < ∞        holding rows
//   0 <= λ < ∞        a limit; bounds of 0 while the limit is out of reach
//   -h T <= λ <= h T  a motor
#include <vector>

#include "engine/constraints/joints.hpp"

namespace spook {

/// Adds the rows of each joint in turn: one for a distance, three for a ball joint, five or six for a hinge, slider or
/// weld, then the row of its limit and that of its motor. Defaults of the joints must be filled in, as a world does.
template <int Dof>
void add_joint_rows(const std::vector<Joint>& joints, double h, const Bodies<Dof>& bodies,
                    std::vector<Row<Dof>>& rows);

}  // namespace spook
