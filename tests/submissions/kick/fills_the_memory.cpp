// Does: takes whatever memory there is, bit by bit.
// Verdict: out of memory
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  std::vector<std::vector<double>> kept;
  for (;;)
    kept.emplace_back().reserve(10'000'000 + static_cast<std::size_t>(std::abs(h * inverse_mass * v.dot(f))));
}

}  // namespace spook
