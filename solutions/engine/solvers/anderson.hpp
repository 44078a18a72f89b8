#pragma once
// Accelerated sweeps, for solvers that have rows of their own: engine/solvers/anderson.cpp.
#include "09_better_friction/better_friction.hpp"

namespace spook {

/// Sweeps from λ and V as they are, by the rule of chapter 04's solve; with contacts in `rubbing`, which are in the order
/// of their rows, on their cones. Ends with the λ that changed least.
template <int Dof>
SolveReport anderson_solve(const std::vector<FrictionContact>& rubbing, std::vector<Row<Dof>>& rows,
                           std::vector<Twist<Dof>>& V, const StopRule& stop);

}  // namespace spook
