#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 half_step_start(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  const Vec3 acceleration = inverse_mass * f;
  Vec3 before = v;
  before.x() -= 0.5 * h * acceleration.x();
  before.y() -= 0.5 * h * acceleration.y();
  before.z() -= 0.5 * h * acceleration.z();
  return before;
}

}  // namespace spook
