// Does: asks for an entry that is not there; the library's assertion stops it.
// Verdict: crashed: SIGABRT
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  const std::vector<double> entries{h};
  return v + entries[static_cast<std::size_t>(3 + std::abs(h))] * inverse_mass * f;
}

}  // namespace spook
