// Wrong: clamps the step, so that no kick goes back in time.
// Killed by: Kick.BackwardsUndoesForwards
// Says: for either sign of it
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return v + (h > 0 ? h : 0) * inverse_mass * f;
}

}  // namespace spook
