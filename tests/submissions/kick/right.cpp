// Does: the right thing, with a helper whose name the tests use, too, tables that the library shares among objects, and
//   letters beyond ASCII: λ, Å.
// Verdict: passed
#include <stdexcept>
#include <string>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

double show(double value) {
  return value;
}

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  if (!std::isfinite(h))
    throw std::invalid_argument("h is " + std::to_string(h) + " in step " + std::to_string(42));
  return v + show(h * inverse_mass) * f;
}

}  // namespace spook
