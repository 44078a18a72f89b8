// Does: writes to address zero.
// Verdict: crashed: SIGSEGV
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  volatile double* volatile nowhere = nullptr;
  *nowhere = h;
  return v + h * inverse_mass * f;
}

}  // namespace spook
