// Does: never returns.
// Verdict: timed out: looped
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  volatile double sum = 0;
  for (;;) sum = sum + v.dot(f) * inverse_mass * h;
}

}  // namespace spook
