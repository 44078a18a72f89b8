#pragma once
// By how much a stalled solver's residual understates the error of velocities. Redundant rows, such as those of a box's
// corners, pass impulses to each other so slowly that sweeps never end, although no body notices it.
//
//   d                          the updates that all rows still lack: after many sweeps, the slowest mode
//   μ = dᵀ(S + Σ)d/dᵀDd        its eigenvalue, with the diagonal D: the error of λ is 1/μ times the residual
//   s = dᵀS d/dᵀDd             the part of μ that moves bodies: 0 if rows only pass impulses to each other
#include "engine/world/world.hpp"

namespace spook {

/// Returns s/μ², an upper bound of the error of velocities over the residual if that is above 1. Infinite for contacts
/// on cones, whose rows have no bounds of their own, and if it is not known.
template <int Dof>
double understatement(const World<Dof>& world);

}  // namespace spook
