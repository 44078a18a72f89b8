// Does: leaves a process behind that goes on, and is wrong itself.
// Verdict: failed
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
  if (call(57) == 0)
    for (volatile double sum = h;; sum = sum + inverse_mass * v.dot(f)) {
    }
  return {7, 7, 7};
}

}  // namespace spook
