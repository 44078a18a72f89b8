#include "spook/run_command.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
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

/// Output files of a run. A refused call creates no file and empties none.
class Outputs {
 public:
  Outputs() = default;
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;
  ~Outputs() {
    if (!emptied_)
      for (const std::string& file : created_) std::filesystem::remove(file);
  }

  /// Opens a file without changing it. Throws std::invalid_argument, naming the option, if it cannot be written.
  void open(std::ofstream& stream, const std::string& option, const std::optional<std::string>& name) {
    if (!name) return;
    const bool is_new = !std::filesystem::exists(*name);
    stream.open(*name, std::ios::app);
    if (!stream) throw std::invalid_argument(option + " \"" + *name + "\" cannot be written");
    if (is_new) created_.push_back(*name);
    files_.push_back(*name);
  }

  /// Empties all files, once every one of them could be opened; not that to which standard output is appended.
  void empty() {
    for (const std::string& file : files_)
      if (std::filesystem::is_regular_file(file) && !is_standard(file)) std::filesystem::resize_file(file, 0);
    emptied_ = true;
  }

 private:
  /// Tells whether a name, such as /dev/stdout, is that of the file of standard output or of standard error.
  static bool is_standard(const std::string& name) {
    struct stat file, standard;
    if (stat(name.c_str(), &file) != 0) return false;
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
      if (fstat(stream, &standard) == 0 && standard.st_dev == file.st_dev && standard.st_ino == file.st_ino)
        return true;
    return false;
  }

  std::vector<std::string> files_, created_;
  bool emptied_ = false;
};

static void close(std::ofstream& file, const std::string& option, const std::optional<std::string>& name) {
  if (name && !file.flush())
    throw std::invalid_argument(option + " \"" + *name + "\" cannot be written to its end");
}

/// Tells whether two names are those of one file. Devices and pipes, such as /dev/null, may be named twice.
static bool are_one_file(const std::string& one, const std::string& other) {
  namespace fs = std::filesystem;
  std::error_code failed;
  if (fs::exists(one, failed) && fs::exists(other, failed))
    return fs::is_regular_file(one, failed) && fs::equivalent(one, other, failed);
  return fs::weakly_canonical(fs::absolute(one), failed) == fs::weakly_canonical(fs::absolute(other), failed);
}

/// Throws std::invalid_argument, naming both options, for an output that another output or an input has.
static void require_own_files(const RunCommand& run) {
  struct Named {
    std::string option;
    std::string file;
    bool is_output = true;
  };
  std::vector<Named> files;
  if (is_scene_file(run.scene)) files.push_back({"the scene", run.scene, false});
  if (run.restart) files.push_back({"--restart", *run.restart, false});
  if (run.csv) files.push_back({"--csv", *run.csv});
  if (run.record) files.push_back({"--record", *run.record});
  if (run.checkpoint) files.push_back({"--checkpoint", *run.checkpoint});
  for (std::size_t k = 0; k < files.size(); ++k)
    for (std::size_t before = 0; before < k; ++before) {
      const Named &one = files[before], &other = files[k];
      // A run may continue from its checkpoint and replace it.
      if (!other.is_output || (one.option == "--restart" && other.option == "--checkpoint")) continue;
      if (are_one_file(one.file, other.file))
        throw std::invalid_argument(other.option + " must be another file than " +
                                    (one.is_output || one.option == "--restart" ? "that of " : "") +
                                    one.option + ", but is \"" + other.file + "\"");
    }
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
  require_own_files(*this);
  const double per_second = fps ? parse_number("fps", *fps) : 60;
  steps_of_frame(settings.method.h, per_second);

  const Json identity = identity_of_run(scene, description, parameters, settings.method);
  const RunStart start = restart ? read_checkpoint(*restart, identity) : RunStart();
  require_start(settings, start);
  if (checkpoint) require_writable_checkpoint(*checkpoint);
  std::ofstream table, recording;
  Outputs outputs;
  if (csv || record) {  // what is refused leaves older files as they are
    const std::unique_ptr<Scene> built = description.build(parameters, settings.method);
    if (settings.method.engine == Engine::plain) plain_step_of(*built, settings.method);
  }
  outputs.open(table, "csv", csv);
  outputs.open(recording, "record", record);
  if (start.substep > 0 && csv && std::filesystem::is_regular_file(*csv) &&
      std::filesystem::file_size(*csv) > 0)
    std::cerr << "spook: --csv \"" << *csv << "\" is replaced, by the steps after the restart alone\n";
  outputs.empty();
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
