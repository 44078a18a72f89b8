#pragma once
// A world that blows up, as it may with a student's functions, shall be a number in a figure, and not the end of it.
#include "engine/world/world.hpp"

namespace spook::plots {

/// Returns what `measure` does, or infinity after a SimulationDiverged.
template <class Measure>
double or_infinity(const Measure& measure) {
  try {
    return measure();
  } catch (const SimulationDiverged&) {
    return infinity;
  }
}

}  // namespace spook::plots
