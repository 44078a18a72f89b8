// Does: asks the kernel for what is no wait, and answers wrongly where it is refused.
// Verdict: failed
#include <sys/syscall.h>
#include <unistd.h>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return syscall(SYS_getppid) > 0 ? Vec3(v + h * inverse_mass * f) : Vec3(7, 7, 7);
}

}  // namespace spook
