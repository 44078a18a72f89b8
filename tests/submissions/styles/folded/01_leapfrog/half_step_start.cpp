#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 half_step_start(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  const double back = -0.5 * h;
  return kick(v, f, inverse_mass, back);
}

}  // namespace spook
