#pragma once
// Times one scene with every engine in turns: ours, another, ours, the next, and so on, in several rounds. So other
// load of the machine slows all engines alike. The fastest round of each counts, in processor time.
#include "peers/engines/cases.hpp"

namespace spook::peers {

struct Lap {
  Way way;
  double error;        ///< by the judge of the case; infinite if the run was lost
  double us_a_second;  ///< processor time per simulated second [µs]; 0 if the run was lost
};

/// The engines with which this program was built, ours first.
std::vector<std::string> engines();

/// Returns a row for each setting of each available engine.
std::vector<Lap> race(const Case& one, int rounds);

}  // namespace spook::peers
