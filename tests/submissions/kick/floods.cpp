// Does: prints without end.
// Verdict: too much output
#include <iostream>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  for (;;) std::cout << "v is " << v.transpose() << " and f " << f.transpose() << h * inverse_mass << std::endl;
}

}  // namespace spook
