// Newton's method with factors over bodies, and its fallbacks:
//
//   on cones     engine/solvers/solve_on_cones.hpp
//   on bounds    engine/solvers/primal_newton.hpp
//
// Accelerated sweeps, engine/solvers/anderson.cpp, follow if a row has Σ = 0, or if both methods fail. A history entry
// is the residual after a factorisation, or the result of a later sweep. Starts from the impulses of the last step.
// Caches the order of elimination of bodies.
#include <algorithm>

#include "engine/solvers/islands.hpp"
#include "engine/solvers/primal_newton.hpp"
#include "engine/solvers/registry.hpp"
#include "engine/solvers/solve_directly.hpp"
#include "engine/solvers/solve_on_cones.hpp"
#include "engine/solvers/solver_result.hpp"

namespace spook {

namespace {

template <int Dof>
class Newton {
 public:
  explicit Newton(FrictionModel model)
      : on_cones_(model == FrictionModel::cone), sweeps_(anderson<Dof>(model)) {}

  SolverResult operator()(const SolverInput<Dof>& s) {
    start_from(s.last.impulses(s.constraints, s.contacts, s.h, s.threads), s.rows(), s.V);
    const auto moves = [](const Row<Dof>& row) { return moves_i(row) || moves_j(row); };
    const auto soft = [](const Row<Dof>& row) { return row.Sigma > 0; };
    if (!std::any_of(s.rows().begin(), s.rows().end(), moves) ||
        !std::all_of(s.rows().begin(), s.rows().end(), soft))
      return sweeps_.solve(s);
    return on_cones_ ? on_cones(s) : on_bounds(s);
  }

 private:
  SolverResult on_cones(const SolverInput<Dof>& s) {
    ConeProblem<Dof> problem(s.rows(), s.V, s.constraints.friction, s.bodies.motion.inverse_mass, *system_);
    SolverResult result = solve_on_cones(problem, s.stop.tolerance, {.factorisations = s.stop.max_sweeps});
    if (result.report.converged) return result;
    return append(std::move(result), sweeps_.solve(s), s.rows().size());
  }

  SolverResult on_bounds(const SolverInput<Dof>& s) {
    auto solved = primal_newton(s.rows(), s.bodies.motion.inverse_mass, s.V, s.stop, *factors_);
    return solved ? without_updates(*std::move(solved)) : sweeps_.solve(s);
  }

  bool on_cones_;
  Solver<Dof> sweeps_;
  ScratchCache<ContactVelocitySystem<Dof>> system_;
  ScratchCache<PrimalFactors<Dof>> factors_;
};

}  // namespace

template <int Dof>
Solver<Dof> newton(FrictionModel model) {
  require_box_or_cone("newton", model);
  return {.solve = Newton<Dof>(model),
          .friction = model == FrictionModel::cone ? model : FrictionModel::box,
          .wants_last = true};
}

template Solver<3> newton<3>(FrictionModel);
template Solver<6> newton<6>(FrictionModel);

}  // namespace spook
