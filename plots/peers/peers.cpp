// Ours beside Bullet, ODE and DART: speed against error, scene by scene; engines/cases.cpp has scenes and settings.
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

Experiment experiment(Size size) {
  Experiment e;
  e.timed = true;
  e.columns = {"scene", "error is", "engine", "solver", "sweeps", "h", "error", "us a second"};
  const bool full = size == Size::full;
  for (const peers::Case& one : full ? peers::cases() : peers::small_cases())
    e.points.push_back({one.name, [one, full] { return rows_of(one, full ? 5 : 1); }});
  e.check = [](const Table&, Claims&) {};
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
