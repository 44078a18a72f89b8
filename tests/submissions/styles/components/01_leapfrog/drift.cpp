#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 drift(const Vec3& x, const Vec3& v, double h) {
  return Vec3(x.x() + v.x() * h, x.y() + v.y() * h, x.z() + v.z() * h);
}

}  // namespace spook
