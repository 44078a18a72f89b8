#pragma once
// The plain engine: the steps that the chapters end with, put in place of a world's own stages.
//
// A world still holds bodies, shapes and joints. Each step copies them into the plain data of the chapters, calls the step
// of the first chapter that has all that the world needs, and copies positions and velocities back. So a hand that pulls,
// a new setting and a new scene need nothing more.
#include "engine/world/world.hpp"

namespace spook {

/// A step of the plain engine for Settings::stepper. It throws std::invalid_argument that names what the world has and no
/// chapter's step runs, such as a hinge.
template <int Dof>
Stepper<Dof> plain_stepper();

/// Returns the exercise whose step runs the world, such as "1.4 leapfrog_step". Throws as its step does.
template <int Dof>
std::string plain_step_of(const World<Dof>& world);

}  // namespace spook
