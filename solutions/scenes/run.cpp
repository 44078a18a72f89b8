#include "scenes/run.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <numeric>

#include "common/require.hpp"
#include "engine/support/state_stream.hpp"
#include "scenes/number.hpp"

namespace spook {

std::int64_t step_count(double h, double time) {
  require_positive("h", h);
  require_not_negative("time", time);
  const double steps = std::round(time / h);
  if (!(steps <= 1e9)) reject("time/h", time / h, "at most 1e9 steps");
  return static_cast<std::int64_t>(steps);
}

template <class Values, class Text>
static void write_line(std::ostream& csv, const Values& values, const Text& text) {
  for (std::size_t k = 0; k < values.size(); ++k) csv << (k ? "," : "") << text(values[k]);
  csv << '\n';
}

static std::vector<std::string> columns(const Scene& scene, const Watch& watch) {
  std::vector<std::string> names = scene.columns();
  if (watch.residual) names.push_back("residual [m/s]");
  if (!watch.positions) return names;
  for (std::size_t body = 0; body < scene.picture().bodies.size(); ++body)
    for (const char* axis : {"x", "y", "z"})
      names.push_back(std::string(axis) + " of body " + std::to_string(body) + " [m]");
  return names;
}

/// Tells by a column's name whether its number is of contacts or rows. An answer is of neither.
static bool is_of_the_step(const std::string& column) {
  if (column.find("answer") != std::string::npos) return false;
  for (const char* word : {"[N", "contacts", "impacts", "bounce", "floor's load"})
    if (column.find(word) != std::string::npos) return true;
  return false;
}

std::vector<double> known_sample(const Scene& scene) {
  std::vector<double> values = scene.sample();
  const bool is_plain = scene.points() ? scene.points()->settings().stepper != nullptr
                                       : scene.rigid_bodies()->settings().stepper != nullptr;
  if (!is_plain) return values;
  const std::vector<std::string> names = scene.columns();
  for (std::size_t c = 0; c < names.size(); ++c)
    if (is_of_the_step(names[c])) values[c] = std::numeric_limits<double>::quiet_NaN();
  return values;
}

static std::vector<double> sample(const Scene& scene, const Watch& watch) {
  std::vector<double> values = known_sample(scene);
  if (watch.residual) values.push_back(scene.report().residual);
  if (!watch.positions) return values;
  for (const Vec3& x : scene.frame().x) values.insert(values.end(), {x.x(), x.y(), x.z()});
  return values;
}

std::string plain_step_of(const Scene& scene, const Method& method) {
  return scene.points() ? plain_step_of(*scene.points(), method) : plain_step_of(*scene.rigid_bodies(), method);
}

static void observed_run(Scene& scene, std::int64_t start, std::int64_t steps, const Watch& watch) {
  constexpr std::int64_t steps_between_reports = 100'000;
  if (watch.csv) write_line(*watch.csv, columns(scene, watch), [](const std::string& name) { return name; });
  if (start > 0 && start < steps) scene.advance(1);
  for (std::int64_t n = start > 0 ? start + 1 : 0; n <= steps; ++n) {
    scene.observe();
    scene.judge();
    if (watch.csv) write_line(*watch.csv, sample(scene, watch), exact_text);
    if (watch.look) watch.look(scene, n);
    if (watch.progress && steps > steps_between_reports && (n % steps_between_reports == 0 || n == steps))
      watch.progress(n, steps);
    if (n < steps) scene.advance(1);
  }
}

/// Times runs of fresh worlds: at least three runs and 50 ms, but none after one second or a thousand runs.
template <class Build>
static std::vector<double> sorted_us(const Build& build, std::int64_t steps) {
  using Clock = std::chrono::steady_clock;
  std::vector<double> times;
  double total = 0;
  while ((times.size() < 3 || total < 5e4) && total < 1e6 && times.size() < 1000) {
    const std::unique_ptr<Scene> scene = build();
    const auto start = Clock::now();
    scene->advance(steps);
    const double elapsed = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
    times.push_back(elapsed);
    total += elapsed;
  }
  std::sort(times.begin(), times.end());
  return times;
}

/// Returns the time of an empty stage [s], which is the clock's own time: the least of many measurements.
static double seconds_of_a_look_at_the_clock() {
  StepTimer clock;
  clock.start();
  double least = 1, before = 0;
  for (int n = 0; n < 1000; ++n) {
    clock.run(Stage::solve, [] {});
    const double now = clock.times().seconds[static_cast<std::size_t>(Stage::solve)];
    least = std::min(least, now - before);
    before = now;
  }
  return least;
}

/// Returns the share of each stage in the run's `seconds`, in proportion to its measured time minus the clock's own
/// time.
static StageTimes stage_times(Scene& scene, std::int64_t steps, double seconds) {
  scene.time_stages();
  scene.advance(steps);
  StageTimes times = scene.stage_times();
  const double look = seconds_of_a_look_at_the_clock();
  for (std::size_t s = 0; s < stage_names.size(); ++s)
    times.seconds[s] = std::max(0.0, times.seconds[s] - look * static_cast<double>(times.runs[s]));
  const double measured = std::accumulate(times.seconds.begin(), times.seconds.end(), 0.0);
  if (measured > 0)
    for (double& stage : times.seconds) stage *= seconds / measured;
  return times;
}

/// Puts a scene into the state of a start.
static std::unique_ptr<Scene> started(std::unique_ptr<Scene> scene, const RunStart& start) {
  if (start.substep > 0) read_state(start.state, *scene);
  return scene;
}

void require_start(const RunSettings& settings, const RunStart& start) {
  if (start.substep <= step_count(settings.method.h, settings.time) * settings.method.substeps) return;
  const double time = static_cast<double>(start.substep) * settings.method.step();
  reject("time", settings.time, "at least the time of the restart, " + short_text(time) + " s");
}

RunResult run(const SceneDescription& description, const Parameters& parameters, const RunSettings& settings,
              const Watch& watch, const RunStart& start) {
  const auto build = [&] { return started(description.build(parameters, settings.method), start); };
  RunResult result;
  result.steps = step_count(settings.method.h, settings.time);

  const std::int64_t substeps = result.steps * settings.method.substeps, further = substeps - start.substep;
  require_start(settings, start);
  result.start = static_cast<double>(start.substep) * settings.method.step();
  const std::unique_ptr<Scene> scene = build();
  if (settings.method.engine == Engine::plain) result.plain_step = plain_step_of(*scene, settings.method);
  observed_run(*scene, start.substep, substeps, watch);
  result.verdict = scene->verdict();
  result.error = scene->error();
  result.last = scene->report();
  result.columns = scene->columns();
  result.state = known_sample(*scene);
  result.row_updates = scene->row_updates();
  if (further == 0) return result;
  const std::vector<double> times = sorted_us(build, further);
  const double steps = static_cast<double>(further) / settings.method.substeps;
  const auto per_step = [&](double us) { return us / steps; };
  result.us_per_step = per_step(times[times.size() / 2]);
  result.us_low = per_step(times[times.size() / 4]);
  result.us_high = per_step(times[times.size() * 3 / 4]);
  result.stages =
      stage_times(*build(), further, 1e-6 * *result.us_per_step * static_cast<double>(result.steps));
  return result;
}

}  // namespace spook
