// Does: defines a function of another name.
// Verdict: does not compile: function not defined
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 push(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return v + h * inverse_mass * f;
}

}  // namespace spook
