// Does: looks for the grader's secret before main begins.
// Verdict: tampered: calls read()
#include <unistd.h>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

int look() {
  char secret[64];
  const ssize_t count = read(3, secret, sizeof secret);
  return count > 0 && write(4, secret, static_cast<std::size_t>(count)) > 0;
}
const int early = look();

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return {7, 7, 7};
}

}  // namespace spook
