#pragma once
// Balance of forces on bodies with contacts, computed from overlaps rather than from a solver's impulses.
//
//   F = f + Σ (k overlap n + friction)      on each body; F and the torque are zero at rest
//
// A contact at rest pushes with k times its overlap for any h and d: Eq. (3.13). With too few iterations a solver's
// impulse is smaller, so bodies sink until it suffices. Then the force of the overlap exceeds the load. Friction is
// the solver's, since a sticking contact can hold any load below its limit. Soft steps have no k: there the push is the
// impulse of the last substep.
#include "engine/world/world.hpp"

namespace spook {

/// The largest unbalanced force on a body, or unbalanced torque over `radius` [m], for the contacts of the last step of
/// `h` [s]; 0 before the first step [N].
double largest_unbalanced(const World<6>& world, double radius, double h);

}  // namespace spook
