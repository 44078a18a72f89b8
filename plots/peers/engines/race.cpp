#include "peers/engines/race.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <map>

#include "peers/engines/spook.hpp"

namespace spook::peers {

namespace {

using Maker = std::function<std::unique_ptr<Engine>(const Problem&, const Way&)>;

const std::map<std::string, Maker>& makers() {
  static const std::map<std::string, Maker> known = {
#ifdef PEER_BULLET
      {"Bullet", make_bullet},
#endif
#ifdef PEER_ODE
      {"ODE", make_ode},
#endif
#ifdef PEER_DART
      {"DART", make_dart},
#endif
#ifdef PEER_MUJOCO
      {"MuJoCo", make_mujoco},
#endif
  };
  return known;
}

/// Returns how often to time a run that took so long with observation [s]; 0 for a long run, whose observed time
/// counts.
int rounds_of(double seconds, int wanted) {
  return seconds > 5 ? 0 : seconds > 1 ? 1 : wanted;
}

/// Returns the processor time of all threads of this program [s].
double processor_time() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Runner {
  Way way;
  std::function<std::unique_ptr<Engine>(std::size_t set)> make;
  double error = 0, seconds = std::numeric_limits<double>::infinity();  // the worst of all parameter sets
  int rounds = 0;
};

std::vector<Runner> runners_of_ours(const Case& one) {
  std::vector<Runner> runners;
  for (const OurWay& way : one.ours)
    for (const double h : way.h)
      for (const int sweeps : way.sweeps) {
        const std::string name = way.cone                    ? "cone"
                                 : way.integrator_order == 4 ? "composed"
                                 : way.soft_steps > 0        ? "soft steps"
                                                             : way.solver;
        const int count = way.soft_steps > 0 ? way.soft_steps : sweeps;
        runners.push_back({{"spook", name, h, count}, [&one, way, h, sweeps](std::size_t set) {
                             if (one.build) return make_spook(our_structure(one, way, sweeps), h);
                             return make_spook(our_scene(one, set, way, h, sweeps));
                           }});
      }
  return runners;
}

/// Returns the initial state of a case.
Problem start_of(const Case& one, std::size_t set, double h) {
  if (one.build) return problem_of(our_structure(one, one.ours.front(), 0));
  return problem_of(*our_scene(one, set, one.ours.front(), h, 0));
}

std::vector<Runner> runners_of_theirs(const Case& one) {
  std::vector<Runner> runners;
  for (const TheirWay& way : one.theirs) {
    const auto maker = makers().find(way.engine);
    if (maker == makers().end()) continue;
    for (const double h : way.h)
      for (const int sweeps : way.sweeps) {
        const Way chosen{way.engine, way.solver, h, sweeps};
        runners.push_back({chosen, [&one, chosen, make = maker->second](std::size_t set) {
                             return make(start_of(one, set, chosen.h), chosen);
                           }});
      }
  }
  return runners;
}

/// Alternates the elements of two lists: ours, theirs, ours, theirs, ..., then the rest of the longer list.
std::vector<Runner> in_turns(const std::vector<Runner>& ours, const std::vector<Runner>& theirs) {
  std::vector<Runner> all;
  for (std::size_t k = 0; k < std::max(ours.size(), theirs.size()); ++k) {
    if (k < ours.size()) all.push_back(ours[k]);
    if (k < theirs.size()) all.push_back(theirs[k]);
  }
  return all;
}

bool lost(const Engine& engine, const Problem& problem) {
  constexpr double far_away = 1e4;  // [m]; in a scene of a few metres
  for (std::size_t i = 0; i < problem.bodies.size(); ++i)
    if (!(engine.x(static_cast<int>(i)).norm() < far_away)) return true;
  return false;
}

std::int64_t steps_of(const Case& one, const Way& way) {
  return static_cast<std::int64_t>(std::llround(one.time / way.h));
}

/// Runs with an observation after every step. The time of the steps counts as a round, too.
double judged(const Case& one, const Runner& runner, std::size_t set, double& seconds) {
  const Problem problem = start_of(one, set, runner.way.h);
  const std::unique_ptr<Engine> engine = runner.make(set);
  const std::unique_ptr<Judge> judge = one.judge(problem);
  judge->look(*engine, 0);
  for (std::int64_t n = 1; n <= steps_of(one, runner.way); ++n) {
    const double start = processor_time();
    try {
      engine->advance(1);
    } catch (const SimulationDiverged&) {
      return infinity;
    } catch (const Lost&) {
      return infinity;
    }
    seconds += processor_time() - start;
    if (lost(*engine, problem)) return infinity;
    judge->look(*engine, static_cast<double>(n) * runner.way.h);
  }
  return judge->error();
}

/// Runs without observation until 20 ms are over; returns the mean time [s].
double timed(const Case& one, const Runner& runner) {
  double total = 0;
  int runs = 0;
  for (; runs == 0 || (total < 0.02 && runs < 100); ++runs)
    for (std::size_t set = 0; set < one.set.size(); ++set) {
      const std::unique_ptr<Engine> engine = runner.make(set);
      const double start = processor_time();
      engine->advance(steps_of(one, runner.way));
      total += processor_time() - start;
    }
  return total / runs;
}

}  // namespace

std::vector<std::string> engines() {
  std::vector<std::string> names = {"spook"};
  for (const auto& [name, make] : makers()) names.push_back(name);
  return names;
}

std::vector<Lap> race(const Case& one, int rounds) {
  std::vector<Runner> runners = in_turns(runners_of_ours(one), runners_of_theirs(one));
  for (Runner& runner : runners) {
    double seconds = 0;
    for (std::size_t set = 0; set < one.set.size(); ++set)
      runner.error = larger(runner.error, judged(one, runner, set, seconds));
    runner.rounds = std::isfinite(runner.error) ? rounds_of(seconds, rounds) : 0;
    if (runner.rounds < rounds) runner.seconds = seconds;
  }
  for (int round = 0; round < rounds; ++round)
    for (Runner& runner : runners)
      if (round < runner.rounds) runner.seconds = std::min(runner.seconds, timed(one, runner));
  std::vector<Lap> laps;
  const double simulated = one.time * static_cast<double>(one.set.size());
  for (const Runner& runner : runners)
    laps.push_back(
        {runner.way, runner.error, std::isfinite(runner.error) ? 1e6 * runner.seconds / simulated : 0});
  return laps;
}

}  // namespace spook::peers
