#pragma once
// The scenes that engines are compared on, and the ways in which each engine is asked to solve them: cases.cpp has all
// settings, and why.
#include <string>
#include <vector>

#include "engine/solvers/registry.hpp"
#include "peers/engines/answers.hpp"

namespace spook::peers {

/// How ours is asked for: as after ./course run.
struct OurWay {
  std::string solver;
  std::vector<double> h;
  std::vector<int> sweeps = {0};  ///< 0: it does not sweep
  bool cone = false;              ///< Coulomb's friction, not the box
  bool warm = false;
  double contact_margin = -1;         ///< [m]; less than 0: the world's own
  std::vector<std::string> set = {};  ///< of the scene, beside the case's
  int integrator_order = 2;           ///< the order of its steps
  double tolerance = 0;               ///< at which sweeps stop [m/s]
  RowOrder row_order = RowOrder::given;
};

/// The same of another engine.
struct TheirWay {
  std::string engine, solver;
  std::vector<double> h;
  std::vector<int> sweeps = {0};
};

struct Case {
  std::string name;
  std::string scene;
  std::vector<std::vector<std::string>>
      set;            ///< of the scene, as after --set; several: the worst of them counts
  double time;        ///< simulated [s]
  std::string error;  ///< what the error is, in words
  MakeJudge judge;
  std::vector<OurWay> ours;
  std::vector<TheirWay> theirs;
};

std::vector<Case> cases();

/// One that takes milliseconds, for each thing that an adapter translates: a case of one way an engine.
std::vector<Case> small_cases();

/// The scene of a case, ready to run in our engine.
std::unique_ptr<Scene> our_scene(const Case& one, std::size_t set, const OurWay& way, double h, int sweeps);

}  // namespace spook::peers
