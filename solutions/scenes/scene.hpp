#pragma once
// A scene: a world built from named parameters, with an answer to compare it with.
//
// A timed run calls advance() only; a run for the error calls observe() after each step. An error is absolute, or
// relative to a scale of the answer (unit "relative"). It is the largest error so far if the answer is a motion, and
// the last error if the answer is a state of rest.
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/diagnostics/run_check.hpp"
#include "engine/support/larger.hpp"
#include "recording/picture.hpp"
#include "scenes/hand.hpp"
#include "scenes/method.hpp"
#include "scenes/parameters.hpp"
#include "scenes/plain_engine.hpp"
#include "scenes/same_sizes.hpp"

namespace spook {

class Scene {
 public:
  virtual ~Scene() = default;

  /// Takes so many steps. Throws SimulationDiverged if the run diverges.
  virtual void advance(std::int64_t steps) = 0;

  /// Compares the current state with the answer.
  virtual void observe() = 0;

  virtual double error() const = 0;

  /// The names of the numbers of sample(), with units in brackets.
  virtual std::vector<std::string> columns() const = 0;

  /// The current state.
  virtual std::vector<double> sample() const = 0;

  virtual StepReport report() const = 0;

  /// Checks the last step; `verdict` tells whether the run is reliable so far.
  virtual void judge() = 0;
  virtual const Verdict& verdict() const = 0;

  /// The number of row updates since the start.
  virtual std::int64_t row_updates() const = 0;

  /// Starts stage timing.
  virtual void time_stages() = 0;
  virtual StageTimes stage_times() const = 0;

  /// The appearance of the scene; the current frame.
  virtual Picture picture() const = 0;
  virtual Frame frame() const = 0;

  /// The positions of bodies in the answer, at the last observe(); the curves of the answer. Default: none.
  virtual std::vector<Ghost> ghosts() const { return {}; }
  virtual std::vector<Curve> curves() const { return {}; }

  /// The energy of the scene's force field, with bodies at `x` [J].
  virtual double field_energy(const std::vector<Vec3>&) const { return 0; }

  /// The scene's world: one of the two is null.
  virtual const World<3>* points() const = 0;
  virtual const World<6>* rigid_bodies() const = 0;

  /// The interaction with the running scene.
  virtual Hand& hand() = 0;

  /// Copies positions, velocities and the hand's balls and grip from a scene that was built with other parameters.
  /// Returns false, and changes nothing, if the two scenes have different bodies, or bodies and joints of other sizes.
  virtual bool take_state_from(const Scene& other) = 0;

  /// Copies what observe() has computed, from a scene that was built with the same parameters and another method.
  virtual void take_results_from(Scene& other) = 0;

  /// Writes or reads all that steps have changed, so that a run continues with the same bits. A reading scene must have
  /// been built with the same parameters and method. Throws as World::state.
  virtual void state(StateStream& s) = 0;
};

struct SceneDescription {
  std::string name;
  std::string summary;     ///< one line
  std::string answer;      ///< the known answer, in words and formulas
  std::string error_name;  ///< meaning of `error`
  std::string error_unit;
  std::vector<Parameter> parameters;
  double h;     ///< default step [s]
  double time;  ///< default duration [s]
  bool solves;  ///< the scene has rows, so solver, iterations and tolerance matter
  /// Builds the scene. Throws std::invalid_argument for parameters that exclude each other.
  std::function<std::unique_ptr<Scene>(const Parameters& parameters, const Method& method)> build;
  std::string solver = "gauss_seidel";  ///< default solver
  /// Default friction model, if it differs from that of Method.
  std::optional<FrictionModel> friction_model = {};
  std::optional<int> integrator_order = {};  ///< default order, if it differs from the world's
  bool chaotic = false;                      ///< round-off alone parts two runs, by their end
  bool from_file = false;                    ///< its bodies may rub without a parameter mu
};

/// Returns the scene with `model` as its default friction model.
inline SceneDescription with_friction(FrictionModel model, SceneDescription scene) {
  scene.friction_model = model;
  scene.build = [model, build = std::move(scene.build)](const Parameters& parameters, Method method) {
    if (!method.friction_model) method.friction_model = model;
    return build(parameters, method);
  };
  return scene;
}

/// The common code of scenes: a world that is advanced in steps of h_.
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
    run_check_.begin_again();
    return hand_;
  }
  bool take_state_from(const Scene& other) final {
    const auto* before = dynamic_cast<const WorldScene*>(&other);
    if (!before || !has_same_sizes(world_, before->world_) || !hand_.take_over(before->hand_)) return false;
    world_.take_state_from(before->world_);
    since_ = before->time();
    return true;
  }
  void take_results_from(Scene& other) final {
    std::string bytes;
    StateStream written(&bytes);
    dynamic_cast<WorldScene&>(other).results(written);
    StateStream unread{std::string_view(bytes)};
    results(unread);
  }
  void state(StateStream& s) final {
    s(world_, run_check_, since_);
    results(s);
  }
  StepReport report() const final { return world_.report(); }
  void judge() final { run_check_.look(world_, h_); }
  const Verdict& verdict() const final { return run_check_.verdict(); }
  std::int64_t row_updates() const final { return world_.row_updates(); }
  void time_stages() final { world_.time_stages(); }
  StageTimes stage_times() const final { return world_.stage_times(); }

 protected:
  WorldScene(Settings<Dof> settings, const Method& method)
      : world_(with(std::move(settings), method)), h_(method.step()), hand_(world_) {}

  /// The time from velocities to positions [s].
  double velocity_lag() const { return world_.velocity_lag(h_); }

  /// Returns an error against an answer that depends on k; NaN with soft steps, which have no k.
  double of_springs(double error) const {
    return world_.settings().soft_steps ? std::numeric_limits<double>::quiet_NaN() : error;
  }

  /// The time in which the impulses of the last step act [s]: that of its last part.
  double impulse_time() const { return h_ / world_.parts(); }

  /// The part of state() that is the scene's own: what observe() computes. Default: nothing.
  virtual void results(StateStream&) {}

  double time() const { return since_ + static_cast<double>(world_.steps()) * h_; }

  World<Dof> world_;
  double h_;  ///< step of the world, that is a substep [s]

 private:
  template <int Wanted>
  const World<Wanted>* this_if() const {
    if constexpr (Wanted == Dof)
      return &world_;
    else
      return nullptr;
  }
  static Settings<Dof> with(Settings<Dof> settings, const Method& method) {
    if (!method.soft_steps) settings.solver = make_solver<Dof>(method);
    settings.solver_limits = method.solver_limits;
    settings.sliding_tangents = method.sliding_tangents;
    settings.warm_start = method.warm_start;
    settings.contact_margin = method.contact_margin;
    if (method.integrator_order) settings.integrator_order = *method.integrator_order;
    if (method.max_parts) settings.max_parts = *method.max_parts;
    settings.threads = method.threads;
    if (method.soft_steps) {
      settings.soft_steps = SoftSteps{.substeps = *method.soft_steps};
      settings.k = settings.d = {};
    }
    if (method.engine == Engine::plain) settings.stepper = plain_stepper<Dof>(method);
    return settings;
  }

  HandIn<Dof> hand_;
  RunCheck<Dof> run_check_;
  double since_ = 0;  // time of the other scene at take_state_from [s]
};

/// error/scale, and 0 for an error of 0 at any scale.
inline double relative(double error, double scale) {
  return error == 0 ? 0 : error / scale;
}

}  // namespace spook
