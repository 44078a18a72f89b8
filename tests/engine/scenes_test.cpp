// Every scene against its own answer, and the answers against independent results.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "checks.hpp"
#include "scene_runs.hpp"

namespace spook::scenes_test {
namespace {

TEST(Registry, EverySceneRunsWithItsDefaults) {
  const std::map<std::string, double> bounds = {
      {"free_fall", 1e-12},
      {"oscillator", 1e-4},
      {"orbit", 1e-2},
      {"top", 1e-3},
      {"resting_sphere", 1e-10},
      {"stack", 1e-2},
      {"incline", 1e-13},
      {"sliding_block", 7e-5},
      {"slide_to_roll", 2.2e-5},
      {"spinning_disc", 1.3e-2},
      {"bouncing_ball", 5e-3},
      {"cradle", 1e-13},
      // A sphere that still rolls a little: a hundredth of its weight, after 4 s.
      {"pile", 1e-2},
      // Its rod is too long by (1 + 2d) h² A/(4l) at most, A = 2g, and half of that is in the period, for 5 s of 4.4
      // m/s. For the double one A is up to about 6g in both rods, and the motion doubles the error.
      {"pendulum", 5e-4},
      {"double_pendulum", 1e-3},
      // A gap is a difference of heights with round-off of 1e-16 m, of a wire of 1 m.
      {"wire", 1e-14},
      {"rope", 5e-4},
      // The lag (1 + 2d) h² A/(4 l) of a thread of 5 cm, A about 200 m/s² as threads pull taut.
      {"cloth", 7e-3},
      // h v of the lag behind a swinging load, (1 + 2d) h² v²/(4 l) of a rod, and T/k: at most 1e-3 for links.
      {"stiff_wire", 1e-3},
      {"closed_loop", 1e-12},
      {"tower", 1e-9},
      {"wall", 1e-5},
      // λ is a difference of gaps over their scale, m g/(n k) = 1e-7 m, with round-off of the height, 1e-17 m.
      {"flat_box_100_contacts", 1e-8},
      // Leapfrog is late by (hω)²/24 of the way, 16 rad at ω = 1.6/s. The hinges' lag (1 + 2d) h² A/(4 l) is three
      // times as much, for 10 s. The rod's ω is 3.8/s, with a tenth of the step.
      {"door", 2e-3},
      {"physical_pendulum", 2e-4},
      // T/(c w) is 2.5e-13.
      {"flywheel", 1e-12},
      // (h ω)²/24 is 4e-4, of a spin that a step of 1/1000 s turns by a tenth; 4.9 rad of precession have a part of it.
      {"gyroscope", 2e-4},
      // (1 + 2d) h² ω² / 4 and the like, with 5/s.
      {"bead", 5e-5},
      // These errors are of second order, with constants that depend on the motion: published in plots/mechanisms.
      {"four_bar", 1e-4},
      {"andrews", 1e-3},
      {"bricard", 1e-4},
      {"slider_crank", 2e-4},
      {"governor", 1e-4}};
  EXPECT_EQ(scenes().size(), bounds.size());
  for (const SceneDescription& scene : scenes()) {
    ASSERT_TRUE(bounds.count(scene.name)) << scene.name << " has no bound here";
    std::ostringstream csv;
    const RunResult result =
        run(scene, Parameters(scene.parameters),
            {.method = {.h = scene.h, .solver = scene.solver}, .time = scene.time}, {.csv = &csv});
    EXPECT_LE(result.error, bounds.at(scene.name)) << scene.name;
    EXPECT_GE(result.error, 0) << scene.name;
    EXPECT_EQ(result.steps, std::lround(scene.time / scene.h));
    ASSERT_TRUE(result.us_per_step.has_value());
    EXPECT_GT(*result.us_per_step, 0);
    EXPECT_EQ(result.stages.runs[static_cast<std::size_t>(Stage::solve)] > 0, scene.solves) << scene.name;
    EXPECT_FALSE(scene.summary.empty() || scene.answer.empty() || scene.error_name.empty() ||
                 scene.error_unit.empty());

    std::istringstream lines(csv.str());
    std::string line;
    ASSERT_TRUE(std::getline(lines, line));
    const auto commas = std::count(line.begin(), line.end(), ',');
    EXPECT_EQ(line.rfind("time [s],", 0), 0U) << line;
    std::int64_t count = 0;
    for (; std::getline(lines, line); ++count)
      ASSERT_EQ(std::count(line.begin(), line.end(), ','), commas) << line;
    EXPECT_EQ(count, result.steps + 1) << scene.name;
  }
}

TEST(Registry, AnErrorTellsWhatTheSolverLeftUndone) {
  const auto error = [](const std::string& name, const SceneSettings& settings, const std::string& solver,
                        int iterations) {
    const SceneDescription& scene = find_scene(name);
    return run_of(name, settings, scene.h, scene.time, {.max_sweeps = iterations}, solver).error;
  };
  // One contact, one rod, or a wheel on its axis: a sweep is a solution. In the cradle impacts determine everything,
  // and rows have nothing left to solve.
  const std::set<std::string> one_sweep_solves = {"resting_sphere", "incline",       "sliding_block",
                                                  "slide_to_roll",  "bouncing_ball", "pendulum",
                                                  "cradle",         "flywheel"};
  // Redundant hinges help a sweep, and a light bead does not turn its rod.
  const std::map<std::string, SceneSettings> where_sweeps_have_work = {{"door", {{"hinges", "1"}}},
                                                                       {"bead", {{"m", "10"}}}};
  for (const SceneDescription& scene : scenes()) {
    if (!scene.solves) continue;
    const auto found = where_sweeps_have_work.find(scene.name);
    const SceneSettings settings = found == where_sweeps_have_work.end() ? SceneSettings{} : found->second;
    const double solved = error(scene.name, settings, scene.solver, StopRule().max_sweeps);
    const double swept = error(scene.name, settings, "gauss_seidel", 1);
    if (one_sweep_solves.count(scene.name))
      EXPECT_NEAR(swept, solved, 1e-6 * solved + 1e-13) << scene.name;
    else
      EXPECT_GE(swept, 2 * solved) << scene.name;
  }
  for (const auto& [name, model] :
       std::map<std::string, std::string>{{"incline", "box"}, {"sliding_block", "box"}, {"pendulum", "body"}})
    EXPECT_GE(error(name, {{"model", model}}, "gauss_seidel", 1),
              2 * error(name, {{"model", model}}, "direct", 50))
        << name << " as " << model;
}

TEST(Registry, EveryChoiceRunsAndEveryLimitIsKept) {
  for (const SceneDescription& scene : scenes())
    for (const Parameter& parameter : scene.parameters) {
      SCOPED_TRACE(scene.name + " " + parameter.name);
      const auto set = [&](const std::string& text) { Parameters(scene.parameters).set(parameter.name, text); };
      EXPECT_NO_THROW(set(parameter.text())) << "the default must be allowed";
      EXPECT_THROW(set("no_such_choice"), std::invalid_argument);
      EXPECT_THROW(set("nan"), std::invalid_argument);
      EXPECT_THROW(set(""), std::invalid_argument);
      for (const std::string& choice : parameter.choices) EXPECT_NO_THROW(set(choice));
      if (!parameter.choices.empty()) continue;
      const Limits& limits = parameter.limits;
      EXPECT_TRUE(limits.allow(parameter.value));
      if (std::isfinite(limits.low)) {
        EXPECT_EQ(limits.allow(limits.low), limits.low_included);
        EXPECT_THROW(set(std::to_string(limits.low - 1)), std::invalid_argument);
      }
      if (std::isfinite(limits.high)) {
        EXPECT_EQ(limits.allow(limits.high), limits.high_included);
        EXPECT_THROW(set(std::to_string(2 * limits.high + 1)), std::invalid_argument);
      }
      if (limits.whole) {
        EXPECT_THROW(set("2.5"), std::invalid_argument);
      }
    }
}

TEST(Registry, NamesMeanTheSameEverywhere) {
  std::map<std::string, std::string> units;
  for (const SceneDescription& scene : scenes())
    for (const Parameter& parameter : scene.parameters) {
      const auto [known, fresh] = units.emplace(parameter.name, parameter.unit);
      EXPECT_EQ(known->second, parameter.unit) << scene.name << " " << parameter.name;
    }
  EXPECT_THROW(find_scene("orbits"), std::invalid_argument);
}

TEST(Parameters, RefuseRepeatedAndUnknownNames) {
  Parameters parameters(find_scene("orbit").parameters);
  parameters.set("axis", "2");
  EXPECT_EQ(parameters.number("axis"), 2);
  EXPECT_THROW(parameters.set("axis", "2"), std::invalid_argument);
  EXPECT_THROW(parameters.set("axes", "2"), std::invalid_argument);
}

TEST(FreeFallScene, ErrorIsThatOfTheDiscreteSum) {
  // -g h² n(n+1)/2 against -g t²/2 at t = nh: a relative error of h/t, largest at the end where it is h n/t².
  const double h = 0.01, time = 5;
  EXPECT_NEAR(error_of("free_fall", {{"start", "unshifted"}}, h, time), h / time, 1e-12 * h);
  EXPECT_LE(error_of("free_fall", {}, h, time), 1e-12);
  EXPECT_EQ(error_of("free_fall", {{"g", "0"}}, h, time), 0);
}

TEST(OscillatorScene, ErrorIsThatOfTheDiscreteFrequency) {
  // Leapfrog turns by 2 asin(h w/2) a step where h w is right, with the half-step start and no other error. So x_n = A
  // cos(n 2 asin(hw/2)), exactly.
  const double h = 0.1, w = std::sqrt(4.0 / 0.25);
  double answer = 0;
  for (int n = 0; n <= 100; ++n)
    answer = std::max(answer, std::abs(std::cos(2 * n * std::asin(h * w / 2)) - std::cos(n * h * w)));
  EXPECT_NEAR(error_of("oscillator", {{"k", "4"}, {"m", "0.25"}, {"amplitude", "3"}}, h, 10), answer, 1e-12);
}

TEST(Scenes, ErrorsFallWithTheirOrder) {
  using testing::expect_order;
  const auto error = [](const std::string& name, const SceneSettings& settings, double time) {
    return [=](double h) { return error_of(name, settings, h, time); };
  };
  const SceneSettings unshifted = {{"start", "unshifted"}};
  expect_order("free_fall, unshifted", "", error("free_fall", unshifted, 4), 0.04, 3, 1, 0.01);
  expect_order("oscillator", "", error("oscillator", {}, 10), 0.04, 3, 2, 0.05);
  expect_order("oscillator, unshifted", "", error("oscillator", unshifted, 10), 0.04, 3, 1, 0.05);
  expect_order("orbit", "", error("orbit", {}, 10), 0.02, 3, 2, 0.05);
  expect_order("orbit, unshifted", "", error("orbit", unshifted, 10), 0.01, 3, 1, 0.1);
  expect_order("top", "", error("top", {}, 40), 0.04, 3, 2, 0.05);
  expect_order("top, wide", "", error("top", {{"wx", "0.5"}}, 20), 0.04, 3, 2, 0.05);
  for (const std::string update : {"first_order", "exponential"})
    expect_order("top, " + update, "", error("top", {{"update", update}}, 40), 0.02, 3, 1, 0.05);
}

TEST(TopScene, RefusesWhatDoesNotGoTogether) {
  const SceneDescription& top = find_scene("top");
  const auto build = [&](const SceneSettings& settings) { top.build(with(top, settings), {.h = 0.01}); };
  EXPECT_THROW(build({{"gyroscopic", "off"}}), std::invalid_argument);
  EXPECT_NO_THROW(build({{"gyroscopic", "off"}, {"update", "first_order"}}));
  EXPECT_THROW(build({{"I2", "1"}}), std::invalid_argument);
  EXPECT_THROW(build({{"I3", "1.5"}}), std::invalid_argument);
  EXPECT_THROW(build({{"wx", "0"}, {"wy", "0"}, {"wz", "0"}}), std::invalid_argument);
}

TEST(RestingSphereScene, IsRightForAnyStepAndRelaxation) {
  for (const std::string d : {"0.5", "1", "2", "3", "10"})
    for (const double h : {1.0 / 30, 1.0 / 60, 1.0 / 1000})
      // x is about radius = 0.5, and its round-off is added to a gap of 1e-5.
      EXPECT_LE(error_of("resting_sphere", {{"d", d}}, h, 8), 1e-10) << "d " << d << ", h " << h;
}

TEST(StackScene, IsRightOnceGaussSeidelIs) {
  const StopRule patient = {.max_sweeps = 100'000, .tolerance = 1e-11};
  const double h = 1.0 / 60;
  EXPECT_LE(error_of("stack", {{"bodies", "1"}}, h, 3, patient), 1e-10);
  EXPECT_LE(error_of("stack", {{"bodies", "10"}}, h, 3, patient), 1e-6);
  EXPECT_LE(error_of("stack", {{"bodies", "2"}, {"ratio", "1000"}}, h, 3, patient), 1e-6);
  EXPECT_LE(error_of("stack", {{"bodies", "2"}, {"ratio", "1000"}, {"heavy", "bottom"}}, h, 3), 1e-8);
  // The default's fifty sweeps are far too few for 1000:1.
  EXPECT_GE(error_of("stack", {{"bodies", "2"}, {"ratio", "1000"}}, h, 3), 0.1);
}

}  // namespace
}  // namespace spook::scenes_test
