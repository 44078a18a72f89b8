// Does: asks for eighty gigabytes at once.
// Verdict: out of memory
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  const std::vector<double> table(10'000'000'000, h);
  return v + table[0] * inverse_mass * f;
}

}  // namespace spook
