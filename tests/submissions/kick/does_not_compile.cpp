// Does: lacks a semicolon.
// Verdict: does not compile
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

// clang-format off
Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return v + h * inverse_mass * f
}
// clang-format on

}  // namespace spook
