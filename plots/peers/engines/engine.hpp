#pragma once
// The interface of all engines: a step, and the positions of bodies.
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "peers/engines/problem.hpp"

namespace spook::peers {

/// Exception of an engine that cannot continue; the other engines still run.
struct Lost {};

class Engine {
 public:
  virtual ~Engine() = default;
  /// Takes steps of the engine's h; may throw Lost or SimulationDiverged.
  virtual void advance(std::int64_t steps) = 0;
  virtual Vec3 x(int body) const = 0;  ///< centre of mass [m]
  virtual Quat q(int body) const = 0;  ///< body to world
};

/// A solver of an engine, with its step and sweeps.
struct Way {
  std::string engine;  ///< spook, Bullet, ODE, DART, MuJoCo
  std::string solver;  ///< name in that engine
  double h;            ///< [s]
  int sweeps = 0;      ///< number of sweeps, for solvers with sweeps
};

std::unique_ptr<Engine> make_bullet(const Problem& problem, const Way& way);
std::unique_ptr<Engine> make_ode(const Problem& problem, const Way& way);
std::unique_ptr<Engine> make_dart(const Problem& problem, const Way& way);
std::unique_ptr<Engine> make_mujoco(const Problem& problem, const Way& way);

}  // namespace spook::peers
