#pragma once
// Recovery: an overlap moves its bodies apart, and leaves them no speed. A joint beyond its limit moves back, and a rope
// that is too long shortens, in the same way.
//
//   u = G (W + W_f + V)            speed at which a contact opens after the solve [m/s]; -a g where an overlap was at rest
//   λ > 0 and u > 0                the contact recovers: it pushes more than stops its bodies
//   S λ' = -G (W + W_f)            its island is solved once more, with closed contacts that stop and do not recover:
//                                  a = b = 0 and Σ = 0, all else as before                                 Eq. (7.17)
//   x += h (W + W_f + V)           positions move with the first solution, the overlap shrinks by the part a h
//   W <- W + W_f + V'              velocities go on with the second: a plastic impact
//
// Which rows of joints recover is in engine/constraints/joint_recovery.hpp. A position that moves with one velocity and
// goes on with another changes the angular momentum a little.
//
// Σ = 0 leaves the corners of a box without one solution; a thousandth of S_kk is taken, which leaves a thousandth of
// the speed that was stopped, inwards.
#include <functional>
#include <optional>
#include <vector>

#include "engine/constraints/joint_recovery.hpp"
#include "engine/solvers/solver.hpp"

namespace spook {

/// Returns the rows of the second solve, from the solved system `s`; λ is that of the first. Returns none where no
/// contact that pushes opens faster than `ignored` [m/s], and no joint recovers. `may_throw` says which contacts are
/// springs, whose rebound stays; null: none.
template <int Dof>
std::optional<ConstraintSet<Dof>> constraints_without_recovery(
    const SolverInput<Dof>& s, double ignored, const std::function<bool(const Contact&)>& may_throw,
    const JointRecovery& joints);

}  // namespace spook
