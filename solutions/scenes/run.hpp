#pragma once
// Runs a scene: once with observation, for its error; a few times without, for its speed; and once with stage timing.
// Reading the clock may take longer than the step of a point mass. So the speed is measured without stage timing, and
// stage times are scaled to add up to the speed.
#include <functional>
#include <optional>
#include <ostream>

#include "scenes/scene.hpp"

namespace spook {

struct RunSettings {
  Method method;
  double time;  ///< [s]
};

struct RunResult {
  std::int64_t steps = 0;
  double start = 0;                   ///< time at which the run began, that of a restart [s]
  double error = 0;                   ///< error in the scene's unit
  Verdict verdict;                    ///< the worst verdict of all steps
  StepReport last;                    ///< report of the last step
  std::vector<std::string> columns;   ///< names of the state's numbers
  std::vector<double> state;          ///< final state, in these columns
  std::int64_t row_updates = 0;       ///< row updates of all steps
  std::optional<double> us_per_step;  ///< median of several runs [µs]; none without steps
  double us_low = 0, us_high = 0;     ///< quartiles of those runs [µs]
  StageTimes stages;                  ///< time of each stage, scaled to add up to us_per_step
  std::string plain_step;  ///< the exercise whose step ran, such as "2.7 step_free"; in the plain engine only
};

/// Returns time/h, rounded. Throws std::invalid_argument unless h > 0 and time >= 0, and for more than 1e9 steps.
std::int64_t step_count(double h, double time);

/// Returns the exercise whose step runs the scene in the plain engine. Throws std::invalid_argument where none does.
std::string plain_step_of(const Scene& scene, const Method& method);

/// Returns the scene's numbers. In the plain engine forces, impulses, and the numbers of contacts, impacts and bounces
/// are NaN, since they do not leave the step.
std::vector<double> known_sample(const Scene& scene);

/// Output of the first run.
struct Watch {
  std::ostream* csv = nullptr;  ///< gets a line of names, and a line for each substep, the start included
  bool positions = false;       ///< adds x, y, z of each body to these lines
  bool residual = false;        ///< adds the residual of the step before [m/s]
  /// Called with the scene at the start, and after each substep.
  std::function<void(Scene& scene, std::int64_t substep)> look = nullptr;
  /// Called with the number of steps done, several times in a long run, and at its end.
  std::function<void(std::int64_t done, std::int64_t steps)> progress = nullptr;
};

/// Start of a run. Default: at time 0.
struct RunStart {
  std::int64_t substep = 0;  ///< number of substeps so far
  std::string state = {};    ///< bytes_of_state of the scene after them; empty at time 0
};

/// Throws std::invalid_argument, naming the time, for a start after the end of the run.
void require_start(const RunSettings& settings, const RunStart& start);

/// Builds the scene and runs it. A run that continues an earlier one writes, and times, only the further steps. Throws
/// std::invalid_argument for bad settings, and as require_start, before it writes anything. Throws SimulationDiverged if
/// the run diverges; output up to that step has been written.
RunResult run(const SceneDescription& scene, const Parameters& parameters, const RunSettings& settings,
              const Watch& watch = {}, const RunStart& start = {});

}  // namespace spook
