#include "scenes/method.hpp"

#include <stdexcept>

namespace spook {

static constexpr const char *accelerated = "anderson", *by_newton = "newton";

/// What has sweeps of its own can not have any other solver, or other sweeps, as well.
static void require_one_solver(const Method& method) {
  if (!method.has_own_sweeps()) return;
  const bool ordered = method.row_order != RowOrder::given;
  const bool plain = method.solver == solvers<3>().front().name;  // Gauss-Seidel
  if (ordered && !plain)
    throw std::invalid_argument("an order of rows is for sweeps: solver must be gauss_seidel, but is " +
                                method.solver);
  if (!ordered && !plain && method.solver != accelerated && method.solver != by_newton)
    throw std::invalid_argument(
        "the cone is for sweeps and Newton's method: solver must be gauss_seidel, anderson or newton, but is " +
        method.solver);
  if (ordered && method.friction_model == FrictionModel::cone)
    throw std::invalid_argument(
        "the cone sweeps in the order that is given: friction-model must be box or two_pass for another order, "
        "but is "
        "cone");
}

template <int Dof>
Solver<Dof> make_solver(const Method& method) {
  const NamedSolver<Dof>& named = find_solver<Dof>(method.solver);
  require_one_solver(method);
  if (method.friction_model == FrictionModel::cone) {
    if (method.solver == by_newton) return newton<Dof>(FrictionModel::cone);
    return method.solver == accelerated ? anderson<Dof>(FrictionModel::cone) : cone_gauss_seidel<Dof>();
  }
  Solver<Dof> solver = method.row_order == RowOrder::given
                           ? named.make()
                           : ordered_gauss_seidel<Dof>(method.row_order, method.seed);
  return method.friction_model == FrictionModel::two_pass ? two_pass(std::move(solver)) : solver;
}

template Solver<3> make_solver<3>(const Method&);
template Solver<6> make_solver<6>(const Method&);

}  // namespace spook
