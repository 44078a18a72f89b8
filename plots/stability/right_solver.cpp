// The hard cases of the other maps, with a suitable solver.
//
//   hanging     wires at rest under a load, by factors of S: the stretch is ΣT/k, Eq. (6.9)
//   swinging    a wire of a hundred links released at 30°, for 2 s, with the stiffness of its tension, Eq. (12.5)
//   towers      boxes with friction under a heavy one, by factors: the top sinks by ΣN/(4k)
//
// k grows with the load, so that all wires have about the same stretch, and all towers the same depth.
#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/world/simulation_diverged.hpp"
#include "machinery/experiment.hpp"
#include "scenes/number.hpp"
#include "scenes/registry.hpp"
#include "stability/grid.hpp"

namespace spook::plots {
namespace {

using Values = std::vector<std::pair<std::string, double>>;

/// The scene's error after `seconds`, infinite if it diverged; and its state, engine/diagnostics/run_check.hpp.
struct SolverResult {
  double error;
  State state;
};

SolverResult outcome(const std::string& name, const Values& values,
                     const std::vector<std::pair<std::string, std::string>>& choices, double h,
                     double seconds) {
  const SceneDescription& scene = find_scene(name);
  Parameters parameters(scene.parameters);
  for (const auto& [parameter, value] : values) parameters.set(parameter, exact_text(value));
  for (const auto& [parameter, choice] : choices) parameters.set(parameter, choice);
  const std::string solver = name == "stiff_wire" ? "geometric_stiffness" : "direct";
  const auto run = scene.build(parameters, {.h = h, .solver = solver, .solver_limits = {.max_sweeps = 200}});
  try {
    run->judge();
    for (int n = 0; n < std::lround(seconds / h); ++n) {
      run->advance(1);
      run->observe();
      run->judge();
    }
  } catch (const SimulationDiverged&) {
    return {infinity, State::lost};
  }
  return {run->error(), run->verdict().state};
}

Experiment experiment(Size size) {
  const bool quick = size == Size::quick;
  Experiment e;
  e.columns = {"what", "across", "up", "error", "lost", "law", "state"};
  const auto add = [&](const std::string& what, double across, double up, double law, double lost_above,
                       auto measure) {
    e.points.push_back({what + " " + exact_text(across) + " " + exact_text(up), [=]() -> std::vector<Row> {
                          const SolverResult found = measure();
                          return {{what, across, up, found.error, double(!(found.error <= lost_above)), law,
                                   name_of(found.state)}};
                        }});
  };
  for (const double links : quick ? std::vector<double>{10, 100} : std::vector<double>{10, 100, 1000, 10'000})
    for (const double ratio : log_spaced(1, 1e8, quick ? 3 : 9))
      add("hanging", links, ratio, 0, 1, [=] {
        const double loaded = ratio + links;
        return outcome("wire", {{"links", links}, {"ratio", ratio}, {"k", 1e4 * links * loaded}},
                       {{"begin", "at_rest"}}, 1.0 / 60, links > 1000 ? 0.25 : 2);
      });
  for (const double ratio : log_spaced(1, 1e6, quick ? 3 : 13))
    for (const double rate :
         quick ? std::vector<double>{60, 240} : std::vector<double>{30, 60, 120, 240, 480, 1000}) {
      const double tension = (ratio + 99) * 0.01 * 9.81 * std::cos(std::acos(-1.0) / 6);
      add("swinging", ratio, 1 / rate, 2 / std::sqrt(4 * tension / (0.01 * 0.1)), 0.5, [=] {
        return outcome("stiff_wire", {{"ratio", ratio}, {"k", 1e12}}, {}, 1 / rate, 2);
      });
    }
  for (const double boxes : quick ? std::vector<double>{2, 10} : std::vector<double>{2, 5, 10, 20, 50, 100})
    for (const double ratio : log_spaced(1, 1e8, quick ? 3 : 5))
      add("towers", boxes, ratio, 0, 1, [=] {
        return outcome("tower", {{"boxes", boxes}, {"ratio", ratio}, {"k", 1e5 * boxes * (ratio + boxes)}}, {},
                       1.0 / 60, 2);
      });
  e.check = [](const Table& table, Claims& claims) {
    const auto worst = [&](const std::string& what, const std::function<bool(double, double)>& counts) {
      const Table some = table.where("what", what);
      const auto across = some.numbers("across"), up = some.numbers("up"), errors = some.numbers("error");
      double largest = 0;
      for (std::size_t n = 0; n < errors.size(); ++n)
        if (counts(across[n], up[n])) largest = std::max(largest, errors[n]);
      return largest;
    };
    claims.at_most(
        "every hanging wire, of 10 to 10,000 links under 1:1 to 10⁸:1, is right to 1e-9 of its length",
        worst("hanging", [](double, double) { return true; }), 1e-9);
    claims.at_most(
        "no link of a wire that swings under 1000:1 or more has an error above 3·10⁻³, at 1/30 s and below",
        worst("swinging", [](double ratio, double) { return ratio > 999; }), 3e-3);
    claims.at_most("every tower of 2 to 100 boxes under 1:1 to 10⁶:1 stands, as deep as it should to 1e-5",
                   worst("towers", [](double, double ratio) { return ratio < 1.1e6; }), 1e-5);
    claims.at_most("under 10⁸:1 towers of up to 20 stand, to 1e-4",
                   worst("towers", [](double boxes, double) { return boxes < 21; }), 1e-4);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
