// Wrong: multiplies unit quaternions for ever, and leaves their roundings in.
// Killed by: FreeRotation.KeepsLFor1e5Steps
// Says: makes each of the two wrong by its length
#include <cmath>

#include "02_quaternions/quaternions.hpp"

namespace spook {

void free_rotation(Quat& q, Vec3& omega, const Vec3& principal, double h) {
  const Vec3 L = world_inertia(q, principal) * omega;
  const auto turn_about_axis = [&](int c, double time) {
    const Vec3 L_body = q.conjugate() * L;
    const double half_angle = time * L_body[c] / principal[c] / 2;
    const Vec3 v = std::sin(half_angle) * Vec3::Unit(c);
    const Quat turn(std::cos(half_angle), v.x(), v.y(), v.z());
    q = q * turn;
  };
  turn_about_axis(0, h / 2);
  turn_about_axis(1, h / 2);
  turn_about_axis(2, h);
  turn_about_axis(1, h / 2);
  turn_about_axis(0, h / 2);
  omega = world_inertia(q, principal.cwiseInverse()) * L;
}

}  // namespace spook
