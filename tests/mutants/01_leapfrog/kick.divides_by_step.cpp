// Wrong: takes h⁻¹ from the notes' (15) at its word.
// Killed by: Kick.AddsForceOverMassTimesStep
// Says: h⁻¹ is a slip
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return v + inverse_mass / h * f;
}

}  // namespace spook
