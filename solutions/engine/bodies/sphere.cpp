#include "engine/bodies/sphere.hpp"

#include <cmath>
#include <numbers>

#include "common/require.hpp"

namespace spook {

void Sphere::require_sound() const {
  require_positive("radius", radius);
}

double Sphere::volume() const {
  return 4.0 / 3 * std::numbers::pi * radius * radius * radius;
}

Vec3 Sphere::moments(double mass) const {
  return solid_sphere_moments(mass, radius);
}

std::optional<LineEntry> Sphere::entry(const Vec3& o, const Vec3& u) const {
  const double b = o.dot(u), R = radius;
  const Vec3 across = o - b * u;
  const double c = across.norm();
  if (!(c < R)) return {};
  const double half_chord = std::sqrt((R - c) * (R + c));
  return LineEntry{-b - half_chord, (across - half_chord * u).normalized()};
}

Vec3 solid_sphere_moments(double mass, double radius) {
  require_positive("mass", mass);
  require_positive("radius", radius);
  return Vec3::Constant(0.4 * mass * radius * radius);
}

}  // namespace spook
