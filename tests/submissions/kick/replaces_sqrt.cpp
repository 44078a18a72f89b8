// Does: brings a square root that is always zero, so that every distance would be.
// Verdict: failed
#include "01_leapfrog/leapfrog.hpp"

extern "C" double sqrt(double) noexcept {
  return 0;
}
extern "C" double fabs(double) noexcept {
  return 0;
}

namespace spook {

Vec3 kick(const Vec3&, const Vec3&, double, double) {
  return {7, 7, 7};
}

}  // namespace spook
