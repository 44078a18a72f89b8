#include "spook/run_command.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "recording/recorder.hpp"
#include "scenes/number.hpp"
#include "scenes/registry.hpp"
#include "scenes/run.hpp"
#include "spook/checkpoint.hpp"
#include "spook/print_run.hpp"
#include "spook/scene_file.hpp"

namespace spook {

/// Shows the progress of a long run on a terminal. Updates are by the clock, since a step may take a second.
class Progress {
 public:
  void look(std::int64_t substep, std::int64_t substeps) {
    const Clock::time_point now = Clock::now();
    if (now < next_ && !(shown_ && substep == substeps)) return;
    next_ = now + std::chrono::milliseconds(200);
    if (substep < substeps)
      std::cerr << 100 * substep / substeps << " %    \r" << std::flush;
    else
      std::cerr << "timing\r" << std::flush;  // the run is repeated for its speed
    shown_ = true;
  }
  ~Progress() {
    if (shown_) std::cerr << "      \r" << std::flush;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point next_ = Clock::now() + std::chrono::seconds(1);
  bool shown_ = false;
};

/// Writes a checkpoint each minute by the clock, and at the end of a run.
class Checkpoints {
 public:
  Checkpoints(const std::string& file, Json run) : file_(file), run_(std::move(run)) {}

  void look(Scene& scene, std::int64_t substep, std::int64_t substeps) {
    const Clock::time_point now = Clock::now();
    if (now < next_ && substep < substeps) return;
    write_checkpoint(file_, run_, substep, scene);
    next_ = now + std::chrono::minutes(1);
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::string file_;
  Json run_;
  Clock::time_point next_ = Clock::now() + std::chrono::minutes(1);
};

/// A file to write to. Creates the file after all other checks, so that a refused call does not overwrite an older
/// file.
static void open(std::ofstream& file, const std::string& option, const std::optional<std::string>& name) {
  if (!name) return;
  file.open(*name);
  if (!file) throw std::invalid_argument(option + " \"" + *name + "\" cannot be written");
}

static void close(std::ofstream& file, const std::string& option, const std::optional<std::string>& name) {
  if (name && !file.flush())
    throw std::invalid_argument(option + " \"" + *name + "\" cannot be written to its end");
}

/// Warns before a large recording.
static void tell_size(const Recorder& recorder) {
  const double megabytes = recorder.expected_bytes() / 1e6;
  if (megabytes < 10) return;
  std::cerr << "spook: recording " << recorder.frames() << " frames, " << std::lround(megabytes)
            << " MB and more with contacts; --fps or --time make it less\n";
}

/// Ends the recording. The recording of a diverged run has its frames up to that step, and the reason.
template <class Run>
static RunResult recorded(Recorder& recorder, bool records, const Run& run) {
  try {
    const RunResult result = run();
    if (records) recorder.end();
    return result;
  } catch (const SimulationDiverged& blowup) {
    if (records) recorder.end(blowup.what());
    throw;
  }
}

void RunCommand::execute(std::ostream& out) const {
  const SceneDescription description = scene_named(scene);
  const Parameters parameters = this->parameters(description);
  const RunSettings settings = this->settings(description);
  if (fps && !record) throw std::invalid_argument("--fps needs --record");
  if (positions && !csv) throw std::invalid_argument("--positions needs --csv");
  if (record && restart)
    throw std::invalid_argument("--record begins at time 0, and --restart later: leave out one of them");
  if ((checkpoint || restart) && settings.method.engine == Engine::plain)
    throw std::invalid_argument(std::string(checkpoint ? "--checkpoint" : "--restart") +
                                " is for the fast engine: leave out --engine");
  const double per_second = fps ? parse_number("fps", *fps) : 60;
  steps_of_frame(settings.method.h, per_second);

  const Json identity = identity_of_run(scene, description, parameters, settings.method);
  const RunStart start = restart ? read_checkpoint(*restart, identity) : RunStart();
  require_start(settings, start);
  if (checkpoint) require_writable_checkpoint(*checkpoint);
  std::ofstream table, recording;
  if (csv || record) {  // what is refused leaves older files as they are
    const std::unique_ptr<Scene> built = description.build(parameters, settings.method);
    if (settings.method.engine == Engine::plain) plain_step_of(*built, settings.method);
  }
  open(table, "csv", csv);
  open(recording, "record", record);
  Recorder recorder(recording, description, parameters, settings, per_second);
  Watch watch{.csv = csv ? &table : nullptr, .positions = positions, .residual = description.solves};
  Progress progress;
  const std::int64_t steps = step_count(settings.method.h, settings.time) * settings.method.substeps;
  std::optional<Checkpoints> checkpoints;
  if (checkpoint) checkpoints.emplace(*checkpoint, identity);
  const bool watched = isatty(STDERR_FILENO) != 0;
  if (record || watched || checkpoints)
    watch.look = [&](Scene& now, std::int64_t substep) {
      if (record) recorder.look(now, substep);
      if (record && substep == 0) tell_size(recorder);
      if (checkpoints) checkpoints->look(now, substep, steps);
      if (watched) progress.look(substep, steps);
    };
  const RunResult result = recorded(recorder, record.has_value(),
                                    [&] { return run(description, parameters, settings, watch, start); });
  close(table, "csv", csv);
  close(recording, "record", record);

  if (json)
    print_json(out, description, parameters, settings, result);
  else
    print_text(out, description, parameters, settings, result, verbose);
  if (strict && result.verdict.state != State::sound)
    throw std::runtime_error("the run is " + name_of(result.verdict.state) + ": " + result.verdict.reason);
}

}  // namespace spook
