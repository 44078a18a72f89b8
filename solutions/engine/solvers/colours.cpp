// Sweeps by colours, four rows in the lanes of an instruction: chapter 14.
//
//   bounds   packs of rows on several threads                   Eq. (14.9), (14.10)
//   cones    packs of contacts; other rows as above             Eq. (14.9), (14.14)
//
// On cones it uses one thread. An entry of its history is the value returned by a sweep. Stores nothing between steps:
// every step makes new packs.
#include <cmath>

#include "14_fast_rows/fast_rows.hpp"
#include "engine/solvers/registry.hpp"
#include "engine/support/larger.hpp"

namespace spook {

template <int Dof>
static SolverResult solve_with_bounds(const SolverInput<Dof>& s) {
  std::vector<Colour<Dof>> colours = packed(s.rows(), s.V.size());
  SolveReport report = solve_in_colours(colours, s.V, s.stop, s.threads);
  unpack(colours, s.rows());
  return report;
}

template <int Dof>
static double sweep_colours(std::vector<Colour<Dof>>& colours, std::vector<Twist<Dof>>& V) {
  double largest = 0;
  for (Colour<Dof>& colour : colours)
    for (Pack<Dof>& pack : colour)
      largest = larger(largest, pack.mu.empty() ? update_pack(pack, V) : update_contact_pack(pack, V));
  return largest;
}

template <int Dof>
static SolverResult solve_on_discs(const SolverInput<Dof>& s) {
  std::vector<Colour<Dof>> colours = packed(s.rows(), s.V.size(), s.constraints.friction);
  SolveReport report;
  report.converged = colours.empty();
  while (!report.converged && std::ssize(report.history) < s.stop.max_sweeps) {
    report.history.push_back(sweep_colours(colours, s.V));
    report.converged = report.history.back() <= s.stop.tolerance;
  }
  unpack(colours, s.rows());
  return report;
}

template <int Dof>
Solver<Dof> colours(FrictionModel model) {
  require_box_or_cone("colours", model);
  return {.solve = model == FrictionModel::cone ? solve_on_discs<Dof> : solve_with_bounds<Dof>,
          .friction = model};
}

template Solver<3> colours<3>(FrictionModel);
template Solver<6> colours<6>(FrictionModel);

}  // namespace spook
