#include "engine/solvers.hpp"

#include <stdexcept>

#include "engine/near_miss.hpp"

namespace spook {

template <int Dof>
const std::vector<NamedSolver<Dof>>& solvers() {
  static const std::vector<NamedSolver<Dof>> table = {
      {"gauss_seidel", "projected Gauss-Seidel, rows in the order in which they were made", &solve<Dof>},
  };
  return table;
}

template <int Dof>
Solver<Dof> find_solver(const std::string& name) {
  std::vector<std::string> names;
  for (const NamedSolver<Dof>& known : solvers<Dof>()) {
    if (known.name == name) return known.solver;
    names.push_back(known.name);
  }
  throw std::invalid_argument("unknown solver \"" + name + "\"" + did_you_mean(name, names));
}

template const std::vector<NamedSolver<3>>& solvers<3>();
template const std::vector<NamedSolver<6>>& solvers<6>();
template Solver<3> find_solver<3>(const std::string&);
template Solver<6> find_solver<6>(const std::string&);

}  // namespace spook
