#include "scenes/disc.hpp"

#include <cmath>

#include "scenes/degrees.hpp"

namespace spook {

std::vector<Vec3> disc_points(double radius, int rings, int points) {
  std::vector<Vec3> all;
  for (int ring = 0; ring < rings; ++ring) {
    const double inner = std::sqrt(static_cast<double>(ring) / rings);
    const double outer = std::sqrt((ring + 1.0) / rings);
    // (R³ - r³)/(R² - r²), without 0/0
    const double mean = radius * 2 / 3 * (outer * outer + outer * inner + inner * inner) / (outer + inner);
    for (int point = 0; point < points; ++point)
      all.push_back(mean * heading(360 * (point + (ring + 0.5) / rings) / points));
  }
  return all;
}

}  // namespace spook
