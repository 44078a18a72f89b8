#pragma once
// Orientations and moments of inertia of rigid bodies, as arrays.
#include <cstddef>
#include <vector>

#include "02_quaternions/quaternions.hpp"

namespace spook {

/// The orientations of point masses, which have none.
template <int Dof>
struct Orientations {
  Quat of(std::size_t) const { return Quat::Identity(); }
};

template <>
struct Orientations<6> {
  std::vector<Quat> q;                  ///< body to world
  std::vector<Vec3> principal;          ///< [kg m²]; zero for a static body
  std::vector<Vec3> inverse_principal;  ///< [1/(kg m²)]; zero for a static body

  const Quat& of(std::size_t i) const { return q[i]; }

  /// Returns the inverse inertia of body i in world coordinates [1/(kg m²)]: Eq. (2.7).
  Mat3 inverse_inertia(std::size_t i) const;
};

/// Tells whether all three moments are equal, so that the inertia is the same in every orientation.
inline bool is_round(const Vec3& principal) {
  return principal.x() == principal.y() && principal.y() == principal.z();
}

}  // namespace spook
