// Does: sends itself a signal that no one can catch.
// Verdict: crashed: SIGKILL
#include <csignal>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  raise(SIGKILL);
  return v + h * inverse_mass * f;
}

}  // namespace spook
