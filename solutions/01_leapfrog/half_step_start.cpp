#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 half_step_start(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return kick(v, f, inverse_mass, -h / 2);  // Eq. (1.5)
}

}  // namespace spook
