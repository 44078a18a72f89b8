#pragma once
// Step size, solver and friction model of a run, by the names of their options.
#include "engine/solvers/registry.hpp"

namespace spook {

/// The engine's own step, or the plain one: the steps that the chapters end with, scenes/plain_engine.hpp.
enum class Engine { fast, plain };

struct Method {
  double h;          ///< [s]
  int substeps = 1;  ///< number of steps of h/substeps in a step
  std::string solver = "gauss_seidel";
  StopRule solver_limits = {};
  /// Default: the cone if the solver supports it, else two passes; with both, friction follows the normal forces.
  std::optional<FrictionModel> friction_model = {};
  bool sliding_tangents = false;
  RowOrder row_order = RowOrder::given;
  std::uint64_t seed = 1;  ///< of a random order
  bool warm_start = false;
  /// The order that steps are composed to, 2 or 4; the scene's own, unless given.
  std::optional<int> integrator_order = {};
  std::optional<int> max_parts = {};  ///< largest number of parts of a step; the scene's own, unless given
  int threads = 1;
  std::optional<double> contact_margin = {};  ///< [m]; the world's own, unless given

  /// The residual that the solver may leave in a step, as a share of the right-hand side; its own, unless given.
  std::optional<double> accuracy = {};

  /// Substeps of soft steps, engine/constraints/soft_rows.hpp, which ignore the scene's k and d; none, unless given.
  std::optional<int> soft_steps = {};

  Engine engine = Engine::fast;
  /// In the plain engine: a solver, friction model, row order or warm start was asked for, so that step_rows of chapter
  /// 09 runs, and any solver after it. Default: the first step that has all features of the scene.
  bool plain_solver = false;

  double step() const { return h / substeps; }  ///< [s]
};

/// Returns the friction model of that name. Throws std::invalid_argument, with the nearest known name, unless the name
/// is box, two_pass or cone.
FrictionModel find_friction_model(const std::string& name);

/// Returns the friction model of a run: the given one, or the default. Throws std::invalid_argument for an unknown
/// solver.
FrictionModel friction_model(const Method& method);

/// Returns the solver that `solver`, `friction_model`, `row_order` and `seed` describe together. Throws
/// std::invalid_argument, naming the options, for an unknown solver, and for options that exclude each other.
template <int Dof>
Solver<Dof> make_solver(const Method& method);

}  // namespace spook
