#pragma once
// Angles in degrees.
#include <cmath>

#include "common/types.hpp"

namespace spook {

inline constexpr double pi = 3.14159265358979323846;

inline double radians(double degrees) {
  return degrees * pi / 180;
}

/// The unit vector in the plane z = 0 at so many degrees from x, exact along an axis.
inline Vec3 heading(double degrees) {
  const auto clean = [](double component) { return std::abs(component) < 1e-15 ? 0 : component; };
  const double angle = radians(std::remainder(degrees, 360));
  return {clean(std::cos(angle)), clean(std::sin(angle)), 0};
}

}  // namespace spook
