#include "engine/bodies/cuboid.hpp"

#include <algorithm>
#include <cmath>

#include "04_gauss_seidel/gauss_seidel.hpp"
#include "common/require.hpp"

namespace spook {

void Cuboid::require_sound() const {
  for (const double half_side : half_sides) require_positive("half side", half_side);
}

Vec3 Cuboid::moments(double mass) const {
  return solid_box_moments(mass, half_sides);
}

double Cuboid::signed_distance(const Vec3& x) const {
  const Vec3 beyond = x.cwiseAbs() - half_sides;
  const double farthest = beyond.maxCoeff();
  return farthest > 0 ? beyond.cwiseMax(0.0).norm() : farthest;
}

std::optional<LineEntry> Cuboid::entry(const Vec3& o, const Vec3& u) const {
  LineEntry last{-infinity, Vec3::Zero()};
  double exit = infinity;
  for (int k = 0; k < 3; ++k) {
    const double h = half_sides[k];
    if (u[k] == 0) {
      if (!(std::abs(o[k]) < h)) return {};
      continue;
    }
    const double towards = std::copysign(1.0, u[k]), in = (-towards * h - o[k]) / u[k];
    if (in > last.t) last = {in, -towards * Vec3::Unit(k)};
    exit = std::min(exit, (towards * h - o[k]) / u[k]);
  }
  if (!(last.t < exit)) return {};
  return last;
}

Vec3 solid_box_moments(double mass, const Vec3& half_sides) {
  require_positive("mass", mass);
  Cuboid{half_sides}.require_sound();
  const Vec3 squares = half_sides.cwiseAbs2();
  return mass / 3 * (Vec3::Constant(squares.sum()) - squares);
}

std::vector<Vec3> box_corners(const Vec3& half_sides) {
  Cuboid{half_sides}.require_sound();
  std::vector<Vec3> corners;
  for (const double x : {-1, 1})
    for (const double y : {-1, 1})
      for (const double z : {-1, 1}) corners.push_back(half_sides.cwiseProduct(Vec3(x, y, z)));
  return corners;
}

}  // namespace spook
