// Wrong: gets ω from L by the inertia instead of its inverse.
// Killed by: FreeRotation.KeepsAngularMomentum
// Says: takes the inverse moments
#include <cmath>

#include "02_quaternions/quaternions.hpp"

namespace spook {

void free_rotation(Quat& q, Vec3& omega, const Vec3& principal, double h) {
  const Vec3 L = world_inertia(q, principal) * omega;

  // One axis's share of the kinetic energy, L_c²/(2 I_c), turns the body about that axis at a constant rate.
  const auto turn_about_axis = [&](int c, double time) {
    const Vec3 L_body = q.conjugate() * L;
    const double half_angle = time * L_body[c] / principal[c] / 2;
    const Vec3 axis_part = std::sin(half_angle) * Vec3::Unit(c);
    q = q * Quat(std::cos(half_angle), axis_part.x(), axis_part.y(), axis_part.z());
  };

  // There and back again, so that the errors of first order cancel: Eq. (2.11).
  turn_about_axis(0, h / 2);
  turn_about_axis(1, h / 2);
  turn_about_axis(2, h);
  turn_about_axis(1, h / 2);
  turn_about_axis(0, h / 2);
  q.normalize();

  omega = world_inertia(q, principal) * L;
}

}  // namespace spook
