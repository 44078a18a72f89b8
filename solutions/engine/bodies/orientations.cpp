#include "engine/bodies/orientations.hpp"

namespace spook {

Mat3 Orientations<6>::inverse_inertia(std::size_t i) const {
  if (is_round(inverse_principal[i])) return inverse_principal[i].asDiagonal();
  return world_inertia(q[i], inverse_principal[i]);
}

}  // namespace spook
