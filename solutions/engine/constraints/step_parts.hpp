#pragma once
// Into how many parts a step is divided, so that joints hold while bodies turn fast or carry heavy loads.
//
//   |ω| h                     angle of a body in a step                            at most 1
//   |ω × r| h / |r|           angle of a lever arm, or of the line of a distance   at most 0.12
//   h √(Σ F / (m L))          frequency of a body on distances that bear F         at most 1
//   h √(Σ F |p| s² / I)       the same about an axis, with levers p across it      at most 1
//   |w| h                     angle of a hinge at the target speed of its motor    as |ω × r| h / |r|, |ω| h
//
// Joints are linear within a step. A point on an arm of length r that turns by α leaves the circle by α²/2 of r, and
// the arm settles at a speed that is 0.7 α² lower: 0.12 holds both to a hundredth. A load F makes light bodies swing
// about it, and leapfrog is stable up to a frequency of 2/h.
//
// These numbers are known before a step, from the forces of the last one. If a part ends with a larger need, as when a
// chain snaps taut, the step is taken again in more parts. The gaps that longer parts have left then close slowly,
// since a fast return would leave the bodies a speed: World::least_relaxation.
#include <functional>
#include <vector>

#include "engine/bodies/bodies.hpp"
#include "engine/constraints/joints.hpp"

namespace spook {

/// Returns the number of parts, not rounded, that a step of `h` [s] needs. Ignores joints with a k of their own.
/// `force_of` returns the force of a joint in the last step [N].
template <int Dof>
double parts_needed(const std::vector<Joint>& joints, const Bodies<Dof>& bodies, double h,
                    const std::function<double(int joint)>& force_of);

}  // namespace spook
