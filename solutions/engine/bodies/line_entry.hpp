#pragma once
// Entry of a line o + t u, for t from -∞ to ∞, into the interior of a shape.
#include "common/types.hpp"

namespace spook {

struct LineEntry {
  double t;     ///< [m] if u has unit length
  Vec3 normal;  ///< of the surface there, outwards, of unit length
};

}  // namespace spook
