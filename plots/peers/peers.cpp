// Speed against error of Spook, Bullet, ODE, DART and MuJoCo, scene by scene; engines/cases.cpp has scenes and settings.
//
//   --only NAME      one of the scenes, by its name or the first letters of the name
//   --rounds N       number of rounds in which all engines run in turns; the fastest round of each counts
#include <CLI/CLI.hpp>
#include <algorithm>

#include "machinery/experiment.hpp"
#include "peers/engines/race.hpp"

namespace spook::plots {
namespace {

std::vector<Row> rows_of(const peers::Case& one, int rounds) {
  std::vector<Row> rows;
  for (const peers::Lap& lap : peers::race(one, rounds))
    rows.push_back({one.name, one.error, lap.way.engine, lap.way.solver, double(lap.way.sweeps), lap.way.h,
                    lap.error, lap.us_a_second});
  return rows;
}

/// The engines with which this program was built.
std::vector<std::string> there_of(const std::vector<std::string>& wanted) {
  const std::vector<std::string> there = peers::engines();
  std::vector<std::string> found;
  for (const std::string& engine : wanted)
    if (std::find(there.begin(), there.end(), engine) != there.end()) found.push_back(engine);
  return found;
}

/// Returns the largest error of some engines in a scene.
double worst(const Table& table, const std::string& scene, const std::vector<std::string>& engines) {
  double worst = 0;
  for (const std::string& engine : engines)
    for (const double error : table.where("scene", scene).where("engine", engine).numbers("error"))
      worst = larger(worst, error);
  return worst;
}

const std::vector<std::string> all = {"spook", "Bullet", "ODE", "DART", "MuJoCo"};

/// The engines that the claims of the full size compare.
const std::vector<std::string> compared = {"spook", "Bullet", "ODE", "DART"};

/// Adds claims that every engine reproduces a closed form, which tests the adapters.
void check_small(const Table& table, Claims& claims) {
  const auto at_most = [&](const std::string& text, const std::string& scene,
                           const std::vector<std::string>& engines, double bound) {
    const std::vector<std::string> there = there_of(engines);
    if (!there.empty()) claims.at_most(text, worst(table, scene, there), bound);
  };
  at_most("at 1/480 s two cubes stay in place in every engine, to 1e-4 of half a side", "tower of 20", all,
          1e-4);
  at_most("a thrown block stops by Coulomb's law, to 1e-5 in spook, ODE and DART", "sliding at four headings",
          {"spook", "ODE", "DART"}, 1e-5);
  at_most("and to 5 per cent in Bullet and MuJoCo", "sliding at four headings", {"Bullet", "MuJoCo"}, 0.05);
  at_most("a sphere rolls after 2v0/(7μg), to 1e-5 in spook, Bullet, ODE and DART", "slide to roll", compared,
          1e-5);
  at_most("and to 1 per cent in MuJoCo", "slide to roll", {"MuJoCo"}, 0.01);
  at_most("a free top turns by Euler's equations for 3 s, to 1e-3 rad", "asymmetric top", all, 1e-3);
  at_most("a double pendulum swings for 2 s by Lagrange's, to 1 per cent", "double pendulum", all, 0.01);
  at_most("peaks of a ball are h0 e^(2n) in spook, to 1e-12", "bounces with e = 0.8", {"spook"}, 1e-12);
  at_most("and to 2 per cent in the others", "bounces with e = 0.8", {"Bullet", "ODE", "DART"}, 0.02);
}

struct Lap {
  double time, error;
};

std::vector<Lap> laps(const Table& table, const std::string& scene, bool ours) {
  std::vector<Lap> found;
  const Table some = table.where("scene", scene);
  const std::vector<std::string> engines = some.texts("engine");
  const std::vector<double> time = some.numbers("us a second"), error = some.numbers("error");
  for (std::size_t k = 0; k < engines.size(); ++k)
    if ((engines[k] == "spook") == ours) found.push_back({time[k], error[k]});
  return found;
}

/// Returns the least time to that error; infinite if no setting reaches it.
double time_to(double error, const std::vector<Lap>& laps) {
  double least = infinity;
  for (const Lap& lap : laps)
    if (lap.error <= error) least = std::min(least, lap.time);
  return least;
}

double least_error(const std::vector<Lap>& laps) {
  double least = infinity;
  for (const Lap& lap : laps) least = std::min(least, lap.error);
  return least;
}

/// Adds claims about speed only for differences that other load on the machine cannot reverse, and only if all engines
/// are available.
void check_all(const Table& table, Claims& claims) {
  if (there_of(compared).size() < compared.size()) return;
  const auto ours = [&](const std::string& scene) { return laps(table, scene, true); };
  const auto others = [&](const std::string& scene) { return laps(table, scene, false); };
  const auto at_sixtieth = [&](const std::string& engine) {
    double least = infinity;
    for (const double error : table.where("scene", "swinging wire 1000:1")
                                  .where("engine", engine)
                                  .where("h", 1.0 / 60)
                                  .numbers("error"))
      least = std::min(least, error);
    return least;
  };
  claims.at_most("at 1/60 s spook swings a wire 1000:1 to 1e-3 of its length", at_sixtieth("spook"), 1e-3);
  claims.at_least("at 1/60 s the others lose that wire",
                  std::min({at_sixtieth("Bullet"), at_sixtieth("ODE"), at_sixtieth("DART")}), 0.1);
  claims.at_least("a free top is right to 0.05 rad in a fiftieth of the others' time or less",
                  time_to(0.05, others("asymmetric top")) / time_to(0.05, ours("asymmetric top")), 50);
  claims.at_most(
      "a block slides by the right distance, to 3.5e-6, in 0.6 of the others' time or less",
      time_to(3.5e-6, ours("sliding at four headings")) / time_to(3.5e-6, others("sliding at four headings")),
      0.6);
  claims.at_most("with 60 composed steps a second the error of spook's double pendulum is at most 1e-6",
                 table.where("solver", "composed").numbers("error").front(), 1e-6);
  claims.at_least("with 1920 steps a second the others have errors of 1e-5 or more",
                  least_error(others("double pendulum")), 1e-5);
}

struct Chosen {
  std::string only;
  int rounds = 5;
};

Experiment experiment(Size size, const Chosen& chosen) {
  Experiment e;
  e.timed = true;
  e.columns = {"scene", "error is", "engine", "solver", "sweeps", "h", "error", "us a second"};
  const bool full = size == Size::full;
  for (const peers::Case& one : full ? peers::cases() : peers::small_cases())
    if (one.name.rfind(chosen.only, 0) == 0)
      e.points.push_back({one.name, [one, rounds = full ? chosen.rounds : 1] { return rows_of(one, rounds); }});
  if (e.points.empty()) throw std::invalid_argument("only: no scene begins with \"" + chosen.only + "\"");
  e.check = [](const Table&, Claims&) {};  // claims need every scene
  if (chosen.only.empty()) e.check = full ? check_all : check_small;
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  spook::plots::Chosen chosen;
  const auto make = [&](spook::plots::Size size) { return spook::plots::experiment(size, chosen); };
  return spook::plots::run_experiment(argc, argv, make, [&](CLI::App& app) {
    app.add_option("--only", chosen.only, "a scene, by the first letters of its name");
    app.add_option("--rounds", chosen.rounds, "how often all run in turns")->check(CLI::Range(1, 100));
  });
}
