// Does: starts a thread that never ends, and is right.
// Verdict: passed
#include <chrono>
#include <thread>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  std::thread([] {
    for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
  }).detach();
  return v + h * inverse_mass * f;
}

}  // namespace spook
