#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 drift(const Vec3& x, const Vec3& v, double h) {
  return x + h * v;  // Eq. (1.4)
}

}  // namespace spook
