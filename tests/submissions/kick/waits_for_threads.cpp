// Does: uses what threads wait by: the library calls the kernel for it.
// Verdict: passed
#include <atomic>
#include <latch>
#include <semaphore>
#include <thread>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  std::latch ready(2);
  std::counting_semaphore<4> free(0);
  std::atomic<int> stage = 0;
  std::jthread other([&] {
    ready.count_down();
    stage = 1;
    stage.notify_all();
    free.release();
  });
  ready.arrive_and_wait();
  stage.wait(0);
  free.acquire();
  return v + h * inverse_mass * f;
}

}  // namespace spook
