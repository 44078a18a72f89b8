// Does: throws before main begins.
// Verdict: crashed: SIGABRT
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

int stumble() {
  throw 42;
}
const int early = stumble();

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return v + h * inverse_mass * f;
}

}  // namespace spook
