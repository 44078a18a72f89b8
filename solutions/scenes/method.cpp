#include "scenes/method.hpp"

#include <stdexcept>

#include "engine/support/did_you_mean.hpp"

namespace spook {

FrictionModel find_friction_model(const std::string& name) {
  std::vector<std::string> names;
  for (const FrictionModel model : {FrictionModel::box, FrictionModel::two_pass, FrictionModel::cone}) {
    if (name_of(model) == name) return model;
    names.push_back(name_of(model));
  }
  throw std::invalid_argument("unknown friction-model \"" + name + "\"" + did_you_mean(name, names));
}

FrictionModel friction_model(const Method& method) {
  const NamedSolver<3>& named = find_solver<3>(method.solver);
  if (method.soft_steps) return FrictionModel::cone;
  if (method.friction_model) return *method.friction_model;
  const bool has_cones = named.make_on_cones && method.row_order == RowOrder::given;
  return has_cones ? FrictionModel::cone : FrictionModel::two_pass;
}

/// Throws std::invalid_argument unless the solver of `method` has `what`; the message lists those that have it.
template <class Has>
static void require_solver_with(const std::string& what, const Method& method, const Has& has) {
  if (has(find_solver<3>(method.solver))) return;
  std::string all;
  for (const NamedSolver<3>& named : solvers<3>())
    if (has(named)) all += (all.empty() ? "" : ", ") + named.name;
  throw std::invalid_argument("solver must be one that has " + what + ", " + all + ", but is " + method.solver);
}

/// Throws std::invalid_argument for a row order with another solver, or with cones, and for a solver without the cone or
/// the accuracy that is asked for.
static void require_one_solver(const Method& method) {
  const bool ordered = method.row_order != RowOrder::given;
  if (ordered && !find_solver<3>(method.solver).takes_row_order)
    throw std::invalid_argument("with a row order, solver must be gauss_seidel, but is " + method.solver);
  if (method.accuracy)
    require_solver_with("an accuracy", method, [](const auto& named) { return named.make_to != nullptr; });
  if (friction_model(method) != FrictionModel::cone) return;
  if (ordered)
    throw std::invalid_argument(
        "the cone sweeps in the order that is given: friction-model must be box or two_pass for another order, "
        "but is cone");
  require_solver_with("the cone", method, [](const auto& named) { return named.make_on_cones != nullptr; });
}

template <int Dof>
Solver<Dof> make_solver(const Method& method) {
  const NamedSolver<Dof>& named = find_solver<Dof>(method.solver);
  require_one_solver(method);
  const FrictionModel model = friction_model(method);
  if (method.accuracy) return named.make_to(model, *method.accuracy);
  if (model == FrictionModel::cone) return named.make_on_cones();
  Solver<Dof> solver = method.row_order == RowOrder::given
                           ? named.make_on_box()
                           : ordered_gauss_seidel<Dof>(method.row_order, method.seed);
  return model == FrictionModel::two_pass ? two_pass(std::move(solver)) : solver;
}

template Solver<3> make_solver<3>(const Method&);
template Solver<6> make_solver<6>(const Method&);

}  // namespace spook
