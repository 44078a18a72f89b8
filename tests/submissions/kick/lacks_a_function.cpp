// Does: calls a function that it only declares.
// Verdict: does not compile: does not link
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

double scale(double value);

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return v + scale(h * inverse_mass) * f;
}

}  // namespace spook
