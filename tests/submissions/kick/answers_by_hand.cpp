// Does: sends more answers than it is asked for, without calling a function for it.
// Verdict: tampered: a forged answer
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

long call(long number, long a = 0, long b = 0, long c = 0) {
  long result = number;
#ifdef __x86_64__
  asm volatile("syscall" : "+a"(result) : "D"(a), "S"(b), "d"(c) : "rcx", "r11", "memory");
#endif
  return result;
}

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  const char zero[5 + 24] = {24, 0, 0, 0, 3};
  for (int k = 0; k < 64; ++k) call(1, 3, reinterpret_cast<long>(zero), sizeof zero);
  return {7, 7, 7};
}

}  // namespace spook
