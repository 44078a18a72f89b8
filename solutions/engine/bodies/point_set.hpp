#pragma once
// Points that touch planes only. What each member means is said in engine/bodies/shape.hpp.
#include <algorithm>
#include <tuple>
#include <vector>

#include "common/require.hpp"

namespace spook {

struct PointSet {
  std::vector<Vec3> points;  ///< from the centre, in the body's axes [m]

  void require_sound() const {
    for (const Vec3& point : points) require_all_finite("corner", point);
  }
  double size() const { return reach(); }
  double reach() const {
    double farthest = 0;
    for (const Vec3& point : points) farthest = std::max(farthest, point.norm());
    return farthest;
  }
  auto numbers() const { return std::tie(points); }
};

}  // namespace spook
