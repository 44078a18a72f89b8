// Gauss-Seidel by contacts: chapter 14, Eq. (14.1)-(14.6). Rows without a contact are updated by Eq. (4.7).
//
// An entry of its history is the value returned by a sweep. Stores nothing between steps.
#include <cmath>

#include "14_fast_rows/fast_rows.hpp"
#include "engine/solvers/registry.hpp"
#include "engine/support/larger.hpp"

namespace spook {

template <int Dof>
static double sweep_blocks(const SolverInput<Dof>& s) {
  double largest = 0;
  const auto note = [&](double lacked) { largest = larger(largest, lacked); };
  auto contact = s.constraints.friction.begin();
  for (std::size_t k = 0; k < s.rows().size(); ++k) {
    if (contact == s.constraints.friction.end() || contact->normal != k) {
      note(s.rows()[k].diagonal * std::abs(update_row(s.rows()[k], s.V)));
      continue;
    }
    note(update_contact(*contact++, s.rows(), s.V));
    k += 2;
  }
  return largest;
}

template <int Dof>
Solver<Dof> blocks() {
  return {.solve = [](const SolverInput<Dof>& s) -> SolverResult {
            SolveReport report;
            report.converged = s.rows().empty();
            while (!report.converged && std::ssize(report.history) < s.stop.max_sweeps) {
              report.history.push_back(sweep_blocks(s));
              report.converged = report.history.back() <= s.stop.tolerance;
            }
            return report;
          },
          .friction = FrictionModel::cone};
}

template Solver<3> blocks<3>();
template Solver<6> blocks<6>();

}  // namespace spook
