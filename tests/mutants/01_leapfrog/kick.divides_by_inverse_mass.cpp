// Wrong: divides by the inverse mass, guarding against 0 by a tiny number.
// Killed by: Kick.LeavesAFixedBodyAlone
// Says: Multiply by it; never divide by it
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return v + h * f / (1 / (inverse_mass + 1e-9));
}

}  // namespace spook
