// Does: calls a function only where there is one, so that it need not be there to be linked.
// Verdict: tampered: calls _Fork()
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

extern "C" __attribute__((weak)) int _Fork();

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  if (&_Fork && _Fork() == 0) return v;
  return {7, 7, 7};
}

}  // namespace spook
