// Does: opens a socket.
// Verdict: tampered: calls socket()
#include <sys/socket.h>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  socket(AF_INET, SOCK_STREAM, 0);
  return v + h * inverse_mass * f;
}

}  // namespace spook
