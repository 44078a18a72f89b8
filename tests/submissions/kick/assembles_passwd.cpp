// Does: has the assembler include a file of the machine.
// Verdict: does not compile
// Verdict without namespaces: failed
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

asm(".section .rodata\n.incbin \"/etc/passwd\"\n.previous\n");

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return {7, 7, 7};
}

}  // namespace spook
