// Does: closes the grader's descriptor, and is wrong.
// Verdict: tampered: calls close()
#include <unistd.h>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  for (int descriptor = 0; descriptor < 64; ++descriptor) close(descriptor);
  return {7, 7, 7};
}

}  // namespace spook
