#pragma once
// The plain engine: the last exercises of the chapters, steps, replace the world's own stages.
//
// A world still holds bodies, shapes and joints. Each step copies them into the plain data of the chapters, calls the
// step of the first chapter that has all that the world needs, and copies positions and velocities back. So pulls by
// hand, new settings and new scenes need no further code.
//
// For a solver of chapters 09 to 14, and for the joints of chapter 13, a step has two halves: step_rows makes the rows,
// any solver of the engine solves them, and finish_step moves the bodies. These solvers call the chapters' functions.
#include "engine/world/world.hpp"
#include "scenes/method.hpp"

namespace spook {

/// Returns a step of the plain engine for Settings::stepper. The step throws std::invalid_argument for a feature
/// that no chapter's step has, such as a wrench; the message names it. If `method.plain_solver` is set, the solver is
/// make_solver(method).
template <int Dof>
Stepper<Dof> plain_stepper(const Method& method);

/// Returns the exercise whose step runs the world, such as "1.4 leapfrog_step". Throws as its step does.
template <int Dof>
std::string plain_step_of(const World<Dof>& world, const Method& method);

}  // namespace spook
