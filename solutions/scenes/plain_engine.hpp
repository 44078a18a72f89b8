#pragma once
// The plain engine: the last exercises of the chapters, steps, replace the world's own stages.
//
// A world still holds bodies, shapes and joints. Each step copies them into the plain data of the chapters, calls the
// step of the first chapter that has all that the world needs, and copies positions and velocities back. So pulls by
// hand, new settings and new scenes need no further code.
#include "engine/world/world.hpp"

namespace spook {

/// Returns a step of the plain engine for Settings::stepper. The step throws std::invalid_argument for a feature
/// that no chapter's step has, such as a hinge; the message names it.
template <int Dof>
Stepper<Dof> plain_stepper();

/// Returns the exercise whose step runs the world, such as "1.4 leapfrog_step". Throws as its step does.
template <int Dof>
std::string plain_step_of(const World<Dof>& world);

}  // namespace spook
