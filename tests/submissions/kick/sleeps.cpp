// Does: waits for nothing, and takes no processor time.
// Verdict: timed out: waited
#include <chrono>
#include <thread>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  std::this_thread::sleep_for(std::chrono::hours(1));
  return v + h * inverse_mass * f;
}

}  // namespace spook
