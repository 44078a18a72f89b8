// Does: puts code where it runs before everything else.
// Verdict: tampered: has code that runs before main or after it, in .init
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

asm(".section .init,\"ax\"\n nop\n .text");

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return {7, 7, 7};
}

}  // namespace spook
