#pragma once
// Points that represent a flat disc of uniform pressure.
#include <vector>

#include "common/types.hpp"

namespace spook {

/// Returns the points of `rings` rings of equal area, with `points` on each, in the plane z = 0. All points carry the
/// same load.
///
/// The points of a ring from r to R are at the mean radius of its area, 2/3 (R³ - r³)/(R² - r²). Over all rings the
/// mean is that of the disc, 2/3 of its radius. Each ring is rotated against the next inner ring by a fraction of the
/// angle between two points, which spreads the angles evenly.
std::vector<Vec3> disc_points(double radius, int rings, int points);

}  // namespace spook
