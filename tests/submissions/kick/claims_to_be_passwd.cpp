// Does: has the compiler take it for another file, and quote that.
// Verdict: does not compile
#include "01_leapfrog/leapfrog.hpp"
#line 1 "/etc/passwd"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return nothing;
}

}  // namespace spook
