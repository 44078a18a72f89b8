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
  if (method.friction_model) return *method.friction_model;
  const bool has_cones = named.make_on_cones && method.row_order == RowOrder::given;
  return has_cones ? FrictionModel::cone : FrictionModel::two_pass;
}

/// Throws std::invalid_argument for a row order with another solver, or with cones.
static void require_one_solver(const Method& method) {
  const bool ordered = method.row_order != RowOrder::given;
  if (ordered && !find_solver<3>(method.solver).takes_row_order)
    throw std::invalid_argument("with a row order, solver must be gauss_seidel, but is " + method.solver);
  if (friction_model(method) != FrictionModel::cone) return;
  if (ordered)
    throw std::invalid_argument(
        "the cone sweeps in the order that is given: friction-model must be box or two_pass for another order, "
        "but is cone");
  if (find_solver<3>(method.solver).make_on_cones) return;
  std::string with_cones;
  for (const NamedSolver<3>& named : solvers<3>())
    if (named.make_on_cones) with_cones += (with_cones.empty() ? "" : ", ") + named.name;
  throw std::invalid_argument("solver must be one that has the cone, " + with_cones + ", but is " +
                              method.solver);
}

template <int Dof>
Solver<Dof> make_solver(const Method& method) {
  const NamedSolver<Dof>& named = find_solver<Dof>(method.solver);
  require_one_solver(method);
  const FrictionModel model = friction_model(method);
  if (method.accuracy && named.make_to) return named.make_to(model, *method.accuracy);
  if (model == FrictionModel::cone) return named.make_on_cones();
  Solver<Dof> solver = method.row_order == RowOrder::given
                           ? named.make()
                           : ordered_gauss_seidel<Dof>(method.row_order, method.seed);
  return model == FrictionModel::two_pass ? two_pass(std::move(solver)) : solver;
}

template Solver<3> make_solver<3>(const Method&);
template Solver<6> make_solver<6>(const Method&);

}  // namespace spook
