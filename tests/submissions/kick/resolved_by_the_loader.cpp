// Does: has a function that the loader resolves, by running code.
// Verdict: tampered: has a function that the loader resolves
#include <unistd.h>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

extern "C" {
double chosen() {
  return 1;
}
double (*choose())() {
  char secret[64];
  if (read(3, secret, sizeof secret) > 0) _exit(0);
  return chosen;
}
double value() __attribute__((ifunc("choose")));
}

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return {7, 7, 7};
}

}  // namespace spook
