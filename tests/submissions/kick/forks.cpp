// Does: leaves a process behind.
// Verdict: tampered: calls fork()
#include <unistd.h>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  if (fork() == 0) sleep(1000);
  return v + h * inverse_mass * f;
}

}  // namespace spook
