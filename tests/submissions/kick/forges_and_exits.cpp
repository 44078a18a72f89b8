// Does: writes a verdict of its own to every descriptor before main begins, and ends.
// Verdict: tampered: calls write()
#include <unistd.h>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

int forge() {
  const char verdict[] = "passed";
  for (int descriptor = 3; descriptor < 64; ++descriptor)
    if (write(descriptor, verdict, sizeof verdict) < 0) continue;
  _exit(0);
}
const int early = forge();

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return {7, 7, 7};
}

}  // namespace spook
