#pragma once
// Accelerated sweeps as a function that other solvers call: engine/solvers/anderson.cpp.
#include "09_better_friction/better_friction.hpp"

namespace spook {

/// Sweeps from the current λ and V, with the stop rule of chapter 04's solve. Contacts in `friction`, in the order of
/// their rows, are on their cones. Ends with the λ that changed least.
template <int Dof>
SolveReport anderson_solve(const std::vector<FrictionContact>& friction, std::vector<Row<Dof>>& rows,
                           std::vector<Twist<Dof>>& V, const std::vector<InverseMass<Dof>>& inverse_mass,
                           const StopRule& stop);

/// Estimates the error that accelerated sweeps have left [m/s]. Their residuals do not fall at a steady rate. So the
/// rate follows from the least residuals in the second and in the last quarter of the history. With fewer than 8 sweeps
/// it is taken as 2 per cent a sweep. The history must not be empty.
double error_of_accelerated(const std::vector<double>& history);

}  // namespace spook
