#include "engine/solvers.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "10_convergence/convergence.hpp"
#include "engine/islands.hpp"
#include "engine/near_miss.hpp"

namespace spook {

namespace {

template <int Dof>
Solver<Dof> gauss_seidel() {
  return &solve<Dof>;
}

template <int Dof>
Solver<Dof> conjugate_gradients() {
  return [](std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V, const StopRule& stop) {
    Outcome outcome = conjugate_solve(rows, V, stop);
    // An iteration is worth four sweeps: two of the preconditioner, one to look, one for S p.
    outcome.row_updates = 4 * std::ssize(outcome.report.history) * std::ssize(rows);
    return outcome;
  };
}

template <int Dof>
Solver<Dof> direct() {
  const auto factors = std::make_shared<Factors>();
  return [factors](std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V, const StopRule& stop) {
    Outcome outcome = direct_solve(rows, V, stop, *factors);
    outcome.row_updates = 0;
    return outcome;
  };
}

template <int Dof>
Solver<Dof> by_island() {
  const auto solver = std::make_shared<IslandSolver<Dof>>();
  return [solver](std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V, const StopRule& stop) {
    return (*solver)(rows, V, stop);
  };
}

}  // namespace

std::int64_t Outcome::updates(std::size_t rows) const {
  return row_updates >= 0 ? row_updates : std::ssize(report.history) * static_cast<std::int64_t>(rows);
}

static void add_trouble(const SolveReport& of, SolveReport& all) {
  if (all.trouble.empty()) all.trouble = of.trouble;
}

Outcome in_turn(Outcome first, const Outcome& second, std::size_t rows) {
  SolveReport& all = first.report;
  first.row_updates = first.updates(rows) + second.updates(rows);
  all.history.insert(all.history.end(), second.report.history.begin(), second.report.history.end());
  all.converged = second.report.converged;
  add_trouble(second.report, all);
  return first;
}

Outcome side_by_side(Outcome one, const Outcome& other) {
  SolveReport& all = one.report;
  one.row_updates += other.row_updates;
  all.history.resize(std::max(all.history.size(), other.report.history.size()), 0);
  for (std::size_t k = 0; k < other.report.history.size(); ++k) {
    const double entry = other.report.history[k];
    if (std::isnan(entry) || entry > all.history[k]) all.history[k] = entry;
  }
  all.converged = all.converged && other.report.converged;
  add_trouble(other.report, all);
  return one;
}

template <int Dof>
const std::vector<NamedSolver<Dof>>& solvers() {
  static const std::vector<NamedSolver<Dof>> table = {
      {"gauss_seidel", "projected Gauss-Seidel, row by row", "sweep", &gauss_seidel<Dof>},
      {"conjugate_gradients", "projected conjugate gradients, preconditioned by sweeps", "iteration",
       &conjugate_gradients<Dof>},
      {"direct", "sparse factors of S; bounds by an interior point method", "factorisation", &direct<Dof>},
      {"auto", "for each island of bodies the direct solver where it is sparse or stiff, else Gauss-Seidel",
       "iteration", &by_island<Dof>},
      {"stiff", "as auto; point masses on tight links get their geometric stiffness", "iteration",
       &by_island<Dof>, true},
  };
  return table;
}

template <int Dof>
const NamedSolver<Dof>& find_solver(const std::string& name) {
  std::vector<std::string> names;
  for (const NamedSolver<Dof>& known : solvers<Dof>()) {
    if (known.name == name) return known;
    names.push_back(known.name);
  }
  throw std::invalid_argument("unknown solver \"" + name + "\"" + did_you_mean(name, names));
}

template const std::vector<NamedSolver<3>>& solvers<3>();
template const std::vector<NamedSolver<6>>& solvers<6>();
template const NamedSolver<3>& find_solver<3>(const std::string&);
template const NamedSolver<6>& find_solver<6>(const std::string&);

}  // namespace spook
