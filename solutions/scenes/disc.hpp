#pragma once
// A flat disc of equal pressure, as a finite number of points.
#include <vector>

#include "common/types.hpp"

namespace spook {

/// So many rings of equal area, with `points` on each, in the plane z = 0. All points carry the same.
///
/// A ring from r to R has its points at the mean distance of its area, 2/3 (R³ - r³)/(R² - r²): over all rings
/// that is the disc's mean, 2/3 of its radius. Each ring is turned against the one inside it, by a part of the
/// angle between two points, which spreads the angles of all points more evenly.
std::vector<Vec3> disc_points(double radius, int rings, int points);

}  // namespace spook
