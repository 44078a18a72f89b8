// Does: asks to be run before any other code.
// Verdict: tampered: has code that runs before main
#include <unistd.h>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

__attribute__((constructor(101))) void first() {
  char secret[64];
  if (read(3, secret, sizeof secret) > 0) _exit(0);
}

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return {7, 7, 7};
}

}  // namespace spook
