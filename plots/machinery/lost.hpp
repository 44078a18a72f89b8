#pragma once
// Represents a run that diverges, as it may with a student's functions, by a number in the figure.
#include "engine/world/world.hpp"

namespace spook::plots {

/// Returns the result of `measure`, or infinity after a SimulationDiverged.
template <class Measure>
double or_infinity(const Measure& measure) {
  try {
    return measure();
  } catch (const SimulationDiverged&) {
    return infinity;
  }
}

}  // namespace spook::plots
