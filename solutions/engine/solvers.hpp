#pragma once
// The solvers, behind one signature, so that an experiment can swap them by name.
#include <string>
#include <vector>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

/// Brings the rows' λ to S λ = B within their bounds, and V to M⁻¹ Gᵀ λ. Both start from what the caller left in
/// them.
template <int Dof>
using Solver = SolveReport (*)(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V, const StopRule& stop);

template <int Dof>
struct NamedSolver {
  std::string name;
  std::string summary;
  Solver<Dof> solver;
};

/// All there are; the first is the default. The names do not depend on Dof.
template <int Dof>
const std::vector<NamedSolver<Dof>>& solvers();

/// Throws std::invalid_argument, with the nearest name there is, for a name that is not one of them.
template <int Dof>
Solver<Dof> find_solver(const std::string& name);

}  // namespace spook
