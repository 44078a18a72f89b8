#include "engine/bodies/capsule.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "04_gauss_seidel/gauss_seidel.hpp"
#include "common/require.hpp"
#include "engine/bodies/sphere.hpp"

namespace spook {

void Capsule::require_sound() const {
  require_positive("radius", radius);
  require_not_negative("half_length", half_length);
}

double Capsule::volume() const {
  return Sphere{radius}.volume() + 2 * half_length * std::numbers::pi * radius * radius;
}

Vec3 Capsule::moments(double mass) const {
  return solid_capsule_moments(mass, radius, half_length);
}

double Capsule::signed_distance(const Vec3& x) const {
  const double z = std::clamp(x.z(), -half_length, half_length);
  return Sphere{radius}.signed_distance(x - z * Vec3::UnitZ());
}

std::optional<LineEntry> Capsule::entry(const Vec3& o, const Vec3& u) const {
  const double sine = u.head<2>().norm(), R = radius;  // 0: along the segment
  const Eigen::Vector2d along = sine > 0 ? (u.head<2>() / sine).eval() : Eigen::Vector2d(0, 0);
  const double b = o.head<2>().dot(along);
  const Eigen::Vector2d across = o.head<2>() - b * along;
  const double c = across.norm();
  if (!(c < R)) return {};
  const double half_chord = std::sqrt((R - c) * (R + c));
  const double t = sine > 0 ? (-b - half_chord) / sine : -infinity;
  const double z = o.z() + t * u.z(), end = std::clamp(z, -half_length, half_length);
  if (z != end) return Sphere{R}.entry(o - end * Vec3::UnitZ(), u);
  Vec3 normal = Vec3::Zero();
  normal.head<2>() = (across - half_chord * along).normalized();
  return LineEntry{t, normal};
}

Vec3 solid_capsule_moments(double mass, double radius, double half_length) {
  require_positive("mass", mass);
  Capsule{radius, half_length}.require_sound();
  const double r = radius, L = half_length;
  const double ball = mass * 2 * r / (2 * r + 3 * L), cylinder = mass - ball;  // 4/3 π r³ to 2 π r² L
  const double across = cylinder * (r * r / 4 + L * L / 3) + ball * (0.4 * r * r + L * L + 0.75 * r * L);
  return {across, across, cylinder * r * r / 2 + ball * 0.4 * r * r};
}

}  // namespace spook
