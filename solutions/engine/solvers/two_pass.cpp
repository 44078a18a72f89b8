// Two passes: chapter 09, Eq. (9.1); notes, "normal forces as limits".
//
//   first     without friction: friction rows have bounds of 0
//   second    with the limits ±μ λ_n of the first pass, starting from its result
//
// Equals two_pass_solve of chapter 09, but with any solver for a pass. Each pass has the whole stop rule, and the
// history contains both. Without friction there is one pass.
#include <stdexcept>

#include "engine/solvers/registry.hpp"

namespace spook {

/// Gives all friction rows bounds of 0.
template <int Dof>
static void release_friction(const std::vector<FrictionContact>& contacts, std::vector<Row<Dof>>& rows,
                             std::vector<Twist<Dof>>& V) {
  for (const FrictionContact& contact : contacts)
    for (const std::size_t k : {contact.normal + 1, contact.normal + 2}) {
      if (rows[k].lambda != 0) apply_impulse(rows[k], -rows[k].lambda, V);
      rows[k].lambda = rows[k].lo = rows[k].hi = 0;
    }
}

template <int Dof>
struct TwoPasses {
  Solver<Dof> inner;

  SolverResult operator()(const SolverInput<Dof>& s) const {
    release_friction(s.constraints.friction, s.rows(), s.V);  // a second solve has the limits of the first
    SolverResult first = inner.solve(s);
    if (s.constraints.friction.empty()) return first;
    limit_friction(s.constraints.friction, s.rows());  // Eq. (9.1)
    return append(std::move(first), inner.solve(s), s.rows().size());
  }

  void state(StateStream& s) { inner.state(s); }
};

template <int Dof>
Solver<Dof> two_pass(Solver<Dof> inner) {
  if (!inner.solve) throw std::invalid_argument("two_pass's solver must be one of solvers(), but is null");
  if (inner.friction != FrictionModel::box)
    throw std::invalid_argument(
        "two_pass's solver must have the friction model box, as automatic(FrictionModel::box) does, but has " +
        name_of(inner.friction));
  const bool wants_last = inner.wants_last;
  return {.solve = TwoPasses<Dof>{std::move(inner)},
          .friction = FrictionModel::two_pass,
          .wants_last = wants_last,
          .state_of_solve = state_of_method<Dof, TwoPasses<Dof>>};
}

template Solver<3> two_pass<3>(Solver<3>);
template Solver<6> two_pass<6>(Solver<6>);

}  // namespace spook
