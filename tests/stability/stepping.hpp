#pragma once
// Steps that may end in a SimulationDiverged, but never in NaN or infinity.
#include <gtest/gtest.h>

#include "engine/world/world.hpp"

namespace spook::testing {

template <int Dof>
bool all_finite(const Bodies<Dof>& bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies.x[i].allFinite() || !bodies.motion.W[i].allFinite()) return false;
    if constexpr (Dof == 6)
      if (!bodies.orientations.q[i].coeffs().allFinite()) return false;
  }
  return true;
}

/// Makes steps, and calls `see` after each, until all are done or one throws a SimulationDiverged, which must name that
/// step and a body. Returns the number of steps done. All bodies' numbers are finite after each.
template <int Dof, class See>
int step_on(World<Dof>& world, double h, int steps, const See& see) {
  for (int n = 1; n <= steps; ++n) {
    try {
      world.step(h);
    } catch (const SimulationDiverged& diverged) {
      EXPECT_EQ(diverged.step(), n);
      EXPECT_GE(diverged.body(), 0);
      EXPECT_LT(diverged.body(), static_cast<int>(world.bodies().size()));
      EXPECT_NE(std::string(diverged.what()).find("step " + std::to_string(n)), std::string::npos)
          << diverged.what();
      EXPECT_NE(std::string(diverged.what()).find("body " + std::to_string(diverged.body())),
                std::string::npos);
      return n - 1;
    }
    if (!all_finite(world.bodies())) {
      ADD_FAILURE() << "step " << n
                    << " ended without a SimulationDiverged, but with numbers that are not finite";
      return n;
    }
    see();
  }
  return steps;
}

template <int Dof>
int step_on(World<Dof>& world, double h, int steps) {
  return step_on(world, h, steps, [] {});
}

}  // namespace spook::testing
