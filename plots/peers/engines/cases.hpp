#pragma once
// The scenes of the comparison, and the settings of each engine; cases.cpp has all settings and their reasons.
#include <string>
#include <vector>

#include "engine/solvers/registry.hpp"
#include "peers/engines/answers.hpp"

namespace spook::peers {

/// Settings of our engine, as options of ./course run.
struct OurWay {
  std::string solver;
  std::vector<double> h;
  std::vector<int> sweeps = {0};  ///< 0: a solver without sweeps
  bool cone = false;              ///< Coulomb's cone instead of the box
  bool warm = false;
  double contact_margin = -1;         ///< [m]; negative: the world's default
  std::vector<std::string> set = {};  ///< parameters of the scene, in addition to the case's
  int integrator_order = 2;           ///< the order of its steps
  double tolerance = 0;               ///< tolerance of sweeps [m/s]
  RowOrder row_order = RowOrder::given;
};

/// Settings of another engine.
struct TheirWay {
  std::string engine, solver;
  std::vector<double> h;
  std::vector<int> sweeps = {0};
};

struct Case {
  std::string name;
  std::string scene;
  std::vector<std::vector<std::string>>
      set;            ///< parameters of the scene, as after --set; of several, the worst counts
  double time;        ///< simulated time [s]
  std::string error;  ///< the error in words
  MakeJudge judge;
  std::vector<OurWay> ours;
  std::vector<TheirWay> theirs;
};

std::vector<Case> cases();

/// Short cases, one for each feature that an adapter translates: one setting per engine.
std::vector<Case> small_cases();

/// Returns the scene of a case, ready to run in our engine.
std::unique_ptr<Scene> our_scene(const Case& one, std::size_t set, const OurWay& way, double h, int sweeps);

}  // namespace spook::peers
