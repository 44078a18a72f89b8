// Does: fills whatever memory there is.
// Verdict: out of memory
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  std::vector<std::vector<double>> kept;
  for (;;) kept.emplace_back(100'000, h + inverse_mass * v.dot(f));
}

}  // namespace spook
