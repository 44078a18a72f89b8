#pragma once
// What holds bodies together, at points that are fixed to them: distances and ball joints, hinges, sliders and welds.
//
//   p   from a body's centre to the point, in the body's own axes; r = q p q* in the world
//   c   axes of the joint in a body's own, third along the hinge or slider; P = q c in the world, Eq. (13.1)
#include <optional>
#include <vector>

#include "13_mechanisms/mechanisms.hpp"
#include "engine/bodies/bodies.hpp"

namespace spook {

enum class JointKind {
  ball,      ///< two points together
  distance,  ///< two points apart by a length
  hinge,     ///< two points together, and free to turn about an axis
  slider,    ///< free to slide along an axis, and not to turn
  weld       ///< not free at all
};

/// "ball", "distance", "hinge", "slider", "weld".
std::string name_of(JointKind kind);

/// A joint as it is handed to a world.
struct Joint {
  int i, j;                           ///< body indices, i ≠ j; not both fixed
  Vec3 p_i = Vec3::Zero();            ///< the point on i, in its axes [m]; zero for a point mass
  Vec3 p_j = Vec3::Zero();            ///< the point on j
  std::optional<double> length = {};  ///< a distance of that length [m]
  std::optional<double> k = {};       ///< stiffness [N/m]; the world's, unless given
  std::optional<double> d = {};       ///< relaxation [steps]; the world's, unless given

  JointKind kind = JointKind::ball;  ///< with a length it is a distance, and need not be said
  // What follows is for hinges, sliders and welds.
  Vec3 axis = Vec3::UnitZ();  ///< of a hinge or slider, in i's axes, of unit length
  /// The axes of j in those of i, q_i* q_j, where the angle is 0. Default: as they are when the joint is added.
  std::optional<Quat> rest = {};
  /// Stiffness of what must not turn [N m/rad]. Default: the number of k, where this is given.
  std::optional<double> k_turn = {};
  std::optional<JointLimits> limits = {};  ///< of the angle [rad] or shift [m]
  std::optional<double> limit_d = {};      ///< relaxation of a limit [steps]; 3, unless given: it settles
  std::optional<Motor> motor = {};
  /// The angle of a hinge after the last step, its turns counted [rad]. Before the first step: the turns that it has made
  /// already, of which only the number counts.
  double angle = 0;
  bool has_default_k = false, has_default_k_turn = false;  ///< set by the world: they follow masses and step

  /// Of all kinds but a ball and a distance.
  bool is_guided() const { return kind > JointKind::distance; }
  /// A limit has one, which comes after those that hold, and a motor one, which comes last.
  int rows() const { return holding_rows() + (limits ? 1 : 0) + (motor ? 1 : 0); }
  int holding_rows() const;
  /// Whether a row is about an angle.
  bool turns(int row) const;
  /// Of the spring that a row is [N/m or N m/rad]; infinite for a motor.
  double stiffness(int row) const;
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

/// The two frames of a hinge, slider or weld as they are now. Its rest must be given.
struct JointFrames {
  JointFrame i, j;
};
JointFrames frames(const Joint& joint, const Bodies<6>& bodies);

/// What a hinge or slider leaves free, as it is now: its angle, not far from `joint.angle`, or its shift.
Coordinate free_coordinate(const Joint& joint, const Bodies<6>& bodies);

/// How far it is from where it holds its bodies: its points [m], and how they are turned [rad].
struct JointGap {
  Vec3 apart = Vec3::Zero(), turned = Vec3::Zero();
};
template <int Dof>
JointGap gap_of(const Joint& joint, const Bodies<Dof>& bodies);

}  // namespace spook
