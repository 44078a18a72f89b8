// Ours beside Bullet, ODE and DART: speed against error, scene by scene; engines/cases.cpp has scenes and settings.
//
//   --only NAME      one of the scenes, by its name or the first letters of it
//   --rounds N       how often all run in turns; the fastest of each counts
#include <CLI/CLI.hpp>

#include "machinery/experiment.hpp"
#include "peers/engines/race.hpp"

namespace spook::plots {
namespace {

std::vector<Row> rows_of(const peers::Case& one, int rounds) {
  std::vector<Row> rows;
  for (const peers::Lap& lap : peers::race(one, rounds))
    rows.push_back({one.name, one.error, lap.way.engine, lap.way.solver, double(lap.way.sweeps), lap.way.h, lap.error,
                    lap.us_a_second});
  return rows;
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
  e.check = [](const Table&, Claims&) {};
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
