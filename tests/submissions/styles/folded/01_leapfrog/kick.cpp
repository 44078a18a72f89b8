#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return Vec3{v}.noalias() += (h * inverse_mass) * f;
}

}  // namespace spook
