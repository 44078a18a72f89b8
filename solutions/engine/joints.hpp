#pragma once
// What holds bodies together: distances and ball joints, between points that are fixed to them.
//
//   p   from a body's centre to the point, in the body's own axes; r = q p q* in the world
#include <optional>
#include <vector>

#include "06_distance/distance.hpp"
#include "engine/bodies.hpp"

namespace spook {

/// A joint as it is handed to a world.
struct Joint {
  int i, j;                           ///< body indices, i ≠ j; not both fixed
  Vec3 p_i = Vec3::Zero();            ///< the point on i, in its axes [m]; zero for a point mass
  Vec3 p_j = Vec3::Zero();            ///< the point on j
  std::optional<double> length = {};  ///< a distance of that length [m]; without one a ball joint
  std::optional<double> k = {};       ///< stiffness [N/m]; the world's, unless given
  std::optional<double> d = {};       ///< relaxation [steps]; the world's, unless given

  int rows() const { return length ? 1 : 3; }
};

/// The attachment of a joint to a body as it is now.
inline Attachment attachment(int body, const Vec3&, const Bodies<3>& bodies) {
  return {.body = body, .x = bodies.x[static_cast<std::size_t>(body)]};
}
inline Attachment attachment(int body, const Vec3& p, const Bodies<6>& bodies) {
  const auto b = static_cast<std::size_t>(body);
  return {.body = body, .x = bodies.x[b], .r = bodies.orientations.q[b] * p};
}

/// How far its two points are from each other [m], rounded as in Eq. (6.2).
template <int Dof>
double distance(const Joint& joint, const Bodies<Dof>& bodies) {
  const Attachment i = attachment(joint.i, joint.p_i, bodies), j = attachment(joint.j, joint.p_j, bodies);
  return ((j.x + j.r) - (i.x + i.r)).norm();
}

}  // namespace spook
