#include "engine/bodies/shape.hpp"

#include <algorithm>
#include <limits>

#include "common/require.hpp"

namespace spook {

static void require_sides(const Vec3& half_sides) {
  for (const double half_side : half_sides) require_positive("half side", half_side);
}

void require_sound(const Shape& shape) {
  match(
      shape, [](const NoShape&) {}, [](const Sphere& sphere) { require_positive("radius", sphere.radius); },
      [](const Capsule& capsule) {
        require_positive("radius", capsule.radius);
        require_not_negative("half_length", capsule.half_length);
      },
      [](const Cuboid& box) { require_sides(box.half_sides); },
      [](const PointSet& set) {
        for (const Vec3& point : set.points) require_all_finite("corner", point);
      });
}

double size_of(const Shape& shape) {
  return match(
      shape, [](const NoShape&) { return std::numeric_limits<double>::infinity(); },
      [](const Sphere& sphere) { return sphere.radius; }, [](const Capsule& capsule) { return capsule.radius; },
      [](const Cuboid& box) { return box.half_sides.minCoeff(); },
      [](const PointSet& set) {
        double farthest = 0;
        for (const Vec3& point : set.points) farthest = std::max(farthest, point.norm());
        return farthest;
      });
}

Vec3 solid_sphere_moments(double mass, double radius) {
  require_positive("mass", mass);
  require_positive("radius", radius);
  return Vec3::Constant(0.4 * mass * radius * radius);
}

Vec3 solid_box_moments(double mass, const Vec3& half_sides) {
  require_positive("mass", mass);
  require_sides(half_sides);
  const Vec3 squares = half_sides.cwiseAbs2();
  return mass / 3 * (Vec3::Constant(squares.sum()) - squares);
}

Vec3 solid_capsule_moments(double mass, double radius, double half_length) {
  require_positive("mass", mass);
  require_sound(Capsule{radius, half_length});
  const double r = radius, L = half_length;
  const double ball = mass * 2 * r / (2 * r + 3 * L), cylinder = mass - ball;  // 4/3 π r³ to 2 π r² L
  const double across = cylinder * (r * r / 4 + L * L / 3) + ball * (0.4 * r * r + L * L + 0.75 * r * L);
  return {across, across, cylinder * r * r / 2 + ball * 0.4 * r * r};
}

std::vector<Vec3> box_corners(const Vec3& half_sides) {
  require_sides(half_sides);
  std::vector<Vec3> corners;
  for (const double x : {-1, 1})
    for (const double y : {-1, 1})
      for (const double z : {-1, 1}) corners.push_back(half_sides.cwiseProduct(Vec3(x, y, z)));
  return corners;
}

}  // namespace spook
