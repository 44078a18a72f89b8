// Does: calls a function by a name that its object gives to it.
// Verdict: tampered: calls fork()
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

asm(".globl innocent\n.set innocent, fork");
extern "C" int innocent();

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return innocent() == 0 ? v : Vec3(7, 7, 7);
}

}  // namespace spook
