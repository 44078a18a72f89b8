// Does: the right thing, with a helper whose name the tests use, too, and letters beyond ASCII: λ, Å.
// Verdict: passed
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

double show(double value) {
  return value;
}

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return v + show(h * inverse_mass) * f;
}

}  // namespace spook
