// Does: asks for too much before main begins.
// Verdict: out of memory
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

const std::vector<double> table(10'000'000'000, 1.0);

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return v + h * inverse_mass * f;
}

}  // namespace spook
