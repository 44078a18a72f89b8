#pragma once
// A scene: a world built from named parameters, with an answer to compare it with.
//
// A scene can be run without looking (advance, which is what is timed) and with looking (observe, after each step). An
// error is relative to its answer's own scale, its unit then "relative"; the largest so far where the answer is a
// motion, the last where it is a state of rest.
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/world.hpp"
#include "scenes/method.hpp"
#include "scenes/parameters.hpp"

namespace spook {

class Scene {
 public:
  virtual ~Scene() = default;

  /// Takes so many steps. Throws Blowup.
  virtual void advance(std::int64_t steps) = 0;

  /// Compares the present state with the answer.
  virtual void observe() = 0;

  virtual double error() const = 0;

  /// Names of what sample() returns, units in brackets.
  virtual std::vector<std::string> columns() const = 0;

  /// The present state.
  virtual std::vector<double> sample() const = 0;

  virtual StepReport report() const = 0;

  /// Row updates since the start.
  virtual std::int64_t row_updates() const = 0;

  /// From now on the stages of each step are timed.
  virtual void time_stages() = 0;
  virtual StageTimes stage_times() const = 0;
};

struct SceneDescription {
  std::string name;
  std::string summary;     ///< one line
  std::string answer;      ///< the known answer, in words and formulas
  std::string error_name;  ///< what `error` is
  std::string error_unit;
  std::vector<Parameter> parameters;
  double h;     ///< default step [s]
  double time;  ///< default duration [s]
  bool solves;  ///< has rows, so that solver, iterations and tolerance matter
  /// Throws std::invalid_argument for parameters that do not go together.
  std::unique_ptr<Scene> (*build)(const Parameters& parameters, const Method& method);
  std::string solver = "gauss_seidel";  ///< the one that it is run with, unless another is asked for
};

/// What the scenes share: a world, stepped by h_.
template <int Dof>
class WorldScene : public Scene {
 public:
  void advance(std::int64_t steps) final {
    for (std::int64_t n = 0; n < steps; ++n) world_.step(h_);
  }
  StepReport report() const final { return world_.report(); }
  std::int64_t row_updates() const final { return world_.row_updates(); }
  void time_stages() final { world_.time_stages(); }
  StageTimes stage_times() const final { return world_.stage_times(); }

 protected:
  WorldScene(Settings<Dof> settings, const Method& method)
      : world_(with(std::move(settings), method)), h_(method.step()) {}

  double time() const { return static_cast<double>(world_.steps()) * h_; }

  World<Dof> world_;
  double h_;  ///< that it is stepped by: a substep's [s]

 private:
  static Settings<Dof> with(Settings<Dof> settings, const Method& method) {
    settings.solver = make_solver<Dof>(method);
    settings.stop = method.stop;
    settings.sliding_tangents = method.sliding_tangents;
    settings.warm_start = method.warm_start;
    settings.margin = method.margin;
    return settings;
  }
};

/// The larger of the two; NaN when either is, where std::max would lose it.
inline double largest(double a, double b) {
  return std::isnan(b) || b > a ? b : a;
}

/// error/scale, and no error is no error at any scale.
inline double relative(double error, double scale) {
  return error == 0 ? 0 : error / scale;
}

}  // namespace spook
