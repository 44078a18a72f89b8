// Does: writes a verdict of its own to the grader's descriptor, and is wrong.
// Verdict: tampered: calls write()
#include <unistd.h>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  const char verdict[] = "00000000000000000000000000000000\0000\0001\000\00000000000000000000000000000000\0";
  if (write(4, verdict, sizeof verdict) < 0) _exit(1);
  return {7, 7, 7};
}

}  // namespace spook
