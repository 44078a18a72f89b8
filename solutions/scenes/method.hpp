#pragma once
// How a scene is stepped and solved, in the words in which it is asked for.
#include "engine/solvers/registry.hpp"

namespace spook {

/// The engine's own step, or the plain one: the steps that the chapters end with, scenes/plain_engine.hpp.
enum class Engine { fast, plain };

struct Method {
  double h;          ///< [s]
  int substeps = 1;  ///< steps of h/substeps that a step is made of
  std::string solver = "gauss_seidel";
  StopRule solver_limits = {};
  /// Default: the cone where the solver has it, else two passes, so that friction follows the normal forces.
  std::optional<FrictionModel> friction_model = {};
  bool sliding_tangents = false;
  RowOrder row_order = RowOrder::given;
  std::uint64_t seed = 1;  ///< of a random order
  bool warm_start = false;
  std::optional<int> integrator_order =
      {};  ///< the order that steps are composed to, 2 or 4; the scene's own, unless given
  int threads = 1;
  std::optional<double> contact_margin = {};  ///< [m]; the world's own, unless given

  Engine engine = Engine::fast;

  double step() const { return h / substeps; }  ///< [s]
};

/// Throws std::invalid_argument, with the nearest name there is, unless it is box, two_pass or cone.
FrictionModel find_friction_model(const std::string& name);

/// The friction model of a run: the one that is given, or the default. Throws std::invalid_argument for an unknown solver.
FrictionModel friction_model(const Method& method);

/// The solver that its `solver`, `friction_model`, `row_order` and `seed` make together.
/// Throws std::invalid_argument, naming them, for an unknown solver, and for two that do not go together.
template <int Dof>
Solver<Dof> make_solver(const Method& method);

}  // namespace spook
