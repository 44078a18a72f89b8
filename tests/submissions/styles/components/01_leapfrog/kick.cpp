#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  Vec3 after;
  for (int axis = 0; axis < 3; ++axis) after[axis] = v[axis] + h * (f[axis] * inverse_mass);
  return after;
}

}  // namespace spook
