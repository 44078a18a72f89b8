#pragma once
// One scene, every engine, in turns: ours, another, ours, the next, and all of that again, so that what else the machine
// does slows all alike. What counts is the fastest round of each, in processor time.
#include "peers/engines/cases.hpp"

namespace spook::peers {

struct Lap {
  Way way;
  double error;        ///< as the case's judge says; infinite where it was lost on the way
  double us_a_second;  ///< of processor time for a simulated second [µs]; 0 where it was lost
};

/// The engines that this program was built with, ours first.
std::vector<std::string> engines();

/// A row for each way of each engine that there is.
std::vector<Lap> race(const Case& one, int rounds);

}  // namespace spook::peers
