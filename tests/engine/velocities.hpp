#pragma once
// The difference of two worlds with the same bodies.
#include <cmath>

#include "engine/world/world.hpp"

namespace spook {

/// The largest difference of two velocities [m/s, rad/s]; NaN if one is.
inline double apart(const World<6>& one, const World<6>& other) {
  double most = 0;
  for (std::size_t b = 0; b < one.bodies().size(); ++b) {
    const double difference = (one.bodies().motion.W[b] - other.bodies().motion.W[b]).norm();
    if (std::isnan(difference) || difference > most) most = difference;
  }
  return most;
}

}  // namespace spook
