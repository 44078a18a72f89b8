// Does: has an array outside its functions that is larger than the memory of a test.
// Verdict: out of memory: before it starts
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

volatile double work[200 << 20];

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  work[0] = h;
  return v + work[0] * inverse_mass * f;
}

}  // namespace spook
