#pragma once
// The scenes of the comparison, and the settings of each engine; cases.cpp has all settings and their reasons.
#include <string>
#include <vector>

#include "engine/solvers/registry.hpp"
#include "peers/engines/answers.hpp"
#include "peers/engines/structures.hpp"

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
  int soft_steps = 0;  ///< substeps of soft steps; 0: none
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
  /// Parameters of the scene, as after --set; of several, the worst counts.
  std::vector<std::vector<std::string>> set;
  double time;        ///< simulated time [s]
  std::string error;  ///< the error in words
  MakeJudge judge;
  std::vector<OurWay> ours;
  std::vector<TheirWay> theirs;
  std::function<World<6>(Settings<6>)> build = {};  ///< of a structure, which is not one of the scenes
};

std::vector<Case> cases();

/// Short cases, one for each feature that an adapter translates: one setting per engine.
std::vector<Case> small_cases();

/// Returns the scene of a case, ready to run in our engine.
std::unique_ptr<Scene> our_scene(const Case& one, std::size_t set, const OurWay& way, double h, int sweeps);

/// Returns the structure of a case, ready to run in our engine.
World<6> our_structure(const Case& one, const OurWay& way, int sweeps);

}  // namespace spook::peers
