// Does: calls itself without end.
// Verdict: crashed: SIGSEGV
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return kick(v, f, inverse_mass, h / 2) + kick(v, f, inverse_mass, h / 2) - v;
}

}  // namespace spook
