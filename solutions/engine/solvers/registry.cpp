#include "engine/solvers/registry.hpp"

#include <stdexcept>

#include "engine/support/did_you_mean.hpp"

namespace spook {

template <int Dof, FrictionModel model>
static Solver<Dof> automatic_of() {
  return automatic<Dof>(model);
}

template <int Dof>
static Solver<Dof> automatic_to(FrictionModel model, double accuracy) {
  return automatic<Dof>(model, accuracy);
}

template <int Dof, FrictionModel model>
static Solver<Dof> stiff_automatic() {
  return geometric_stiffness(automatic<Dof>(model));
}

template <int Dof>
static Solver<Dof> stiff_automatic_to(FrictionModel model, double accuracy) {
  return geometric_stiffness(automatic<Dof>(model, accuracy));
}

template <int Dof, FrictionModel model>
static Solver<Dof> anderson_of() {
  return anderson<Dof>(model);
}

template <int Dof, FrictionModel model>
static Solver<Dof> newton_of() {
  return newton<Dof>(model);
}

template <int Dof, FrictionModel model>
static Solver<Dof> colours_of() {
  return colours<Dof>(model);
}

template <int Dof>
const std::vector<NamedSolver<Dof>>& solvers() {
  using enum FrictionModel;
  static const std::vector<NamedSolver<Dof>> table = {
      {"gauss_seidel", "projected Gauss-Seidel, row by row", "sweep", &gauss_seidel<Dof>,
       &cone_gauss_seidel<Dof>, true},
      {"conjugate_gradients", "projected conjugate gradients, preconditioned by sweeps; without cones",
       "iteration", &conjugate_gradients<Dof>, nullptr},
      {"anderson", "Gauss-Seidel with Anderson acceleration", "sweep", &anderson_of<Dof, box>,
       &anderson_of<Dof, cone>},
      {"newton", "Newton's method on bounds or cones, with factors over bodies; interior point if it fails",
       "factorisation", &newton_of<Dof, box>, &newton_of<Dof, cone>},
      {"spatial_decomposition",
       "Gauss-Seidel in stripes of space: for large piles on several threads; without cones", "sweep",
       &spatial_decomposition<Dof>, nullptr},
      {"colours", "Gauss-Seidel by colours, four rows or contacts in the lanes of an instruction", "sweep",
       &colours_of<Dof, box>, &colours_of<Dof, cone>},
      {"blocks", "Gauss-Seidel by contacts; on a box or in two passes as gauss_seidel", "sweep",
       &gauss_seidel<Dof>, &blocks<Dof>},
      {"direct", "sparse factors of S; bounds by an interior-point method; without cones", "factorisation",
       &direct<Dof>, nullptr},
      {"auto", "for each island of bodies: the direct solver if it is cheap or needed, else Gauss-Seidel",
       "iteration", &automatic_of<Dof, box>, &automatic_of<Dof, cone>, false, &automatic_to<Dof>},
      {"geometric_stiffness", "as auto; point masses on tight links get their geometric stiffness", "iteration",
       &stiff_automatic<Dof, box>, &stiff_automatic<Dof, cone>, false, &stiff_automatic_to<Dof>},
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
