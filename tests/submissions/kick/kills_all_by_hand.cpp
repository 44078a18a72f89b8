// Does: kills every process that it may, without calling a function for it.
// Verdict: crashed: SIGKILL
#include <cstdlib>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

long call(long number, long first = 0, long second = 0) {
  long result = number;
#ifdef __x86_64__
  asm volatile("syscall" : "+a"(result) : "D"(first), "S"(second) : "rcx", "r11", "memory");
#endif
  return result;
}

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  for (long process : {-1L, 1L, call(110)}) call(62, process, 9);  // kill(process, SIGKILL)
  for (;;) std::abort();
}

}  // namespace spook
