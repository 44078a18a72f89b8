#pragma once
// Whether bodies on contacts are in balance, by what their overlaps say and not by what a solver does.
//
//   F = f + Σ (k overlap n + friction)      of each body; at rest it is zero, and so is the torque
//
// A contact at rest pushes with k times its overlap, whatever h and d: Eq. (3.13). A solver that does too little gives
// less, and bodies sink until it is enough; then their overlaps push more than they carry. Friction is what the solver
// made of it: what is stuck may hold any load.
#include "engine/world/world.hpp"

namespace spook {

/// The largest force on a body that nothing balances, or torque over `radius` [m], with contacts as the last step of `h`
/// found them [N]; 0 before the first.
double largest_unbalanced(const World<6>& world, double radius, double h);

}  // namespace spook
