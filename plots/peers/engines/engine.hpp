#pragma once
// What every engine can do: step, and say where its bodies are. Its own word on its errors is not asked for.
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "peers/engines/problem.hpp"

namespace spook::peers {

/// Exception of an engine that cannot go on; the other engines still run.
struct Lost {};

class Engine {
 public:
  virtual ~Engine() = default;
  virtual void advance(
      std::int64_t steps) = 0;  ///< with the h that it was made for; may throw Lost or SimulationDiverged
  virtual Vec3 x(int body) const = 0;  ///< centre of mass [m]
  virtual Quat q(int body) const = 0;  ///< body to world
};

/// One of an engine's solvers, and what it may cost.
struct Way {
  std::string engine;  ///< spook, Bullet, ODE, DART
  std::string solver;  ///< in the engine's own word
  double h;            ///< [s]
  int sweeps = 0;      ///< of solvers that sweep
};

std::unique_ptr<Engine> make_bullet(const Problem& problem, const Way& way);
std::unique_ptr<Engine> make_ode(const Problem& problem, const Way& way);
std::unique_ptr<Engine> make_dart(const Problem& problem, const Way& way);

}  // namespace spook::peers
