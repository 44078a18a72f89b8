#pragma once
// A scene: a world built from named parameters, with an answer to compare it with.
//
// A scene can be run without looking (advance, which is what is timed) and with looking (observe, after each step). An
// error is relative to its answer's own scale, its unit then "relative"; the largest so far where the answer is a
// motion, the last where it is a state of rest.
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/diagnostics/run_check.hpp"
#include "recording/picture.hpp"
#include "scenes/hand.hpp"
#include "scenes/method.hpp"
#include "scenes/parameters.hpp"
#include "scenes/plain_engine.hpp"

namespace spook {

class Scene {
 public:
  virtual ~Scene() = default;

  /// Takes so many steps. Throws SimulationDiverged.
  virtual void advance(std::int64_t steps) = 0;

  /// Compares the present state with the answer.
  virtual void observe() = 0;

  virtual double error() const = 0;

  /// Names of what sample() returns, units in brackets.
  virtual std::vector<std::string> columns() const = 0;

  /// The present state.
  virtual std::vector<double> sample() const = 0;

  virtual StepReport report() const = 0;

  /// Judges the step that was just taken; `verdict` says if the run is reliable so far.
  virtual void judge() = 0;
  virtual const Verdict& verdict() const = 0;

  /// Row updates since the start.
  virtual std::int64_t row_updates() const = 0;

  /// Starts stage timing.
  virtual void time_stages() = 0;
  virtual StageTimes stage_times() const = 0;

  /// What it looks like, and what it looks like now.
  virtual Picture picture() const = 0;
  virtual Frame frame() const = 0;

  /// Where the answer has bodies now, as of the last observe(); and lines on which it lies. None, unless the scene says.
  virtual std::vector<Ghost> ghosts() const { return {}; }
  virtual std::vector<Curve> curves() const { return {}; }

  /// The energy of its force field, with bodies at `x` [J].
  virtual double field_energy(const std::vector<Vec3>&) const { return 0; }

  /// Its world: of point masses or of rigid bodies, and null for the other.
  virtual const World<3>* points() const = 0;
  virtual const World<6>* rigid_bodies() const = 0;

  /// What a hand can do to it.
  virtual Hand& hand() = 0;

  /// Takes over the bodies of a scene that was built with other numbers: where they are, how they move, and what a hand
  /// did. False, and nothing is done, where the two have not the same bodies.
  virtual bool take_state_from(const Scene& other) = 0;
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
  std::function<std::unique_ptr<Scene>(const Parameters& parameters, const Method& method)> build;
  std::string solver = "gauss_seidel";  ///< the one that it is run with, unless another is asked for
  /// The friction model, unless another is asked for. Default: that of Method.
  std::optional<FrictionModel> friction_model = {};
  std::optional<int> integrator_order = {};  ///< unless another is asked for. Default: the world's
};

/// Returns the scene with a friction model of its own: it is built with that one, unless another is asked for.
inline SceneDescription with_friction(FrictionModel model, SceneDescription scene) {
  scene.friction_model = model;
  scene.build = [model, build = std::move(scene.build)](const Parameters& parameters, Method method) {
    if (!method.friction_model) method.friction_model = model;
    return build(parameters, method);
  };
  return scene;
}

/// What the scenes share: a world, stepped by h_.
template <int Dof>
class WorldScene : public Scene {
 public:
  void advance(std::int64_t steps) final {
    for (std::int64_t n = 0; n < steps; ++n) world_.step(h_);
  }
  Picture picture() const final {
    Picture picture = picture_of(world_);
    if (hand_.anchor()) picture.bodies[world_.index(*hand_.anchor())].is_hand = true;
    return picture;
  }
  Frame frame() const final {
    Frame frame = frame_of(world_, h_);
    std::vector<Vec3> x = frame.x;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= velocity_lag() * frame.v[i];
    frame.energy.field = field_energy(x);
    return frame;
  }
  const World<3>* points() const final { return this_if<3>(); }
  const World<6>* rigid_bodies() const final { return this_if<6>(); }
  Hand& hand() final {
    soundness_.begin_again();
    return hand_;
  }
  bool take_state_from(const Scene& other) final {
    const auto* before = dynamic_cast<const WorldScene*>(&other);
    if (!before || !hand_.take_over(before->hand_)) return false;
    world_.take_state_from(before->world_);
    since_ = before->time();
    return true;
  }
  StepReport report() const final { return world_.report(); }
  void judge() final { soundness_.look(world_, h_); }
  const Verdict& verdict() const final { return soundness_.verdict(); }
  std::int64_t row_updates() const final { return world_.row_updates(); }
  void time_stages() final { world_.time_stages(); }
  StageTimes stage_times() const final { return world_.stage_times(); }

 protected:
  WorldScene(Settings<Dof> settings, const Method& method)
      : world_(with(std::move(settings), method)), h_(method.step()), hand_(world_) {}

  /// How far velocities are behind positions [s].
  double velocity_lag() const { return world_.velocity_lag(h_); }

  double time() const { return since_ + static_cast<double>(world_.steps()) * h_; }

  World<Dof> world_;
  double h_;  ///< that it is stepped by: a substep's [s]

 private:
  template <int Wanted>
  const World<Wanted>* this_if() const {
    if constexpr (Wanted == Dof)
      return &world_;
    else
      return nullptr;
  }
  static Settings<Dof> with(Settings<Dof> settings, const Method& method) {
    settings.solver = make_solver<Dof>(method);
    settings.solver_limits = method.solver_limits;
    settings.sliding_tangents = method.sliding_tangents;
    settings.warm_start = method.warm_start;
    settings.contact_margin = method.contact_margin;
    if (method.integrator_order) settings.integrator_order = *method.integrator_order;
    settings.threads = method.threads;
    if (method.engine == Engine::plain) settings.stepper = plain_stepper<Dof>();
    return settings;
  }

  HandIn<Dof> hand_;
  RunCheck<Dof> soundness_;
  double since_ = 0;  // when it took over [s]
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
