// Does: ends with success in a handler that exit would call, and is wrong.
// Verdict: failed
#include <cstdlib>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

const int early = std::atexit([] { std::quick_exit(0); });

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return {7, 7, 7};
}

}  // namespace spook
