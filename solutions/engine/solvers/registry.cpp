#include "engine/solvers/registry.hpp"

#include <stdexcept>

#include "engine/support/did_you_mean.hpp"

namespace spook {

template <int Dof>
static Solver<Dof> stiff_automatic() {
  return geometric_stiffness(automatic<Dof>());
}

template <int Dof>
static Solver<Dof> anderson_of_rows() {
  return anderson<Dof>();
}

template <int Dof>
static Solver<Dof> newton_of_rows() {
  return newton<Dof>();
}

template <int Dof>
const std::vector<NamedSolver<Dof>>& solvers() {
  static const std::vector<NamedSolver<Dof>> table = {
      {"gauss_seidel", "projected Gauss-Seidel, row by row", "sweep", &gauss_seidel<Dof>},
      {"conjugate_gradients", "projected conjugate gradients, preconditioned by sweeps", "iteration",
       &conjugate_gradients<Dof>},
      {"anderson", "Gauss-Seidel, accelerated by what its last sweeps changed", "sweep",
       &anderson_of_rows<Dof>},
      {"newton", "Newton's method on bounds or cones, by factors on bodies; accelerated sweeps where it fails",
       "factorisation", &newton_of_rows<Dof>},
      {"spatial_decomposition", "Gauss-Seidel in stripes of space: for large piles on several threads", "sweep",
       &spatial_decomposition<Dof>},
      {"direct", "sparse factors of S; bounds by an interior point method", "factorisation", &direct<Dof>},
      {"auto", "for each island of bodies the direct solver where it is sparse or stiff, else Gauss-Seidel",
       "iteration", &automatic<Dof>},
      {"geometric_stiffness", "as auto; point masses on tight links get their geometric stiffness", "iteration",
       &stiff_automatic<Dof>},
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
