#pragma once
// Joints between two bodies: distances, ball joints, hinges, sliders and welds.
//
//   p   from a body's centre to the joint's point, in the body's own axes; r = q p q* in the world
//   c   axes of the joint in a body's own axes, third along the hinge or slider; P = q c in the world, Eq. (13.1)
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "13_mechanisms/mechanisms.hpp"
#include "engine/bodies/bodies.hpp"

namespace spook {

enum class JointKind {
  ball,      ///< two points coincide
  distance,  ///< two points keep a distance
  rope,      ///< two points have a largest distance
  hinge,     ///< two points coincide; only rotation about an axis is free
  slider,    ///< only a shift along an axis is free
  weld       ///< no relative motion is free
};

/// Properties of a kind of joint.
struct JointProperties {
  JointKind kind;
  const char* name;
  int along, about;            ///< holding rows: first those along axes, then those about axes
  bool has_length = false;     ///< of the distance, or the largest one
  bool has_free_axis = false;  ///< it may have limits, a spring and a motor
};

/// All kinds, in the order of JointKind.
inline constexpr std::array<JointProperties, 6> joint_properties = {
    {{JointKind::ball, "ball", 3, 0},
     {JointKind::distance, "distance", 1, 0, true},
     {JointKind::rope, "rope", 1, 0, true},
     {JointKind::hinge, "hinge", 3, 2, false, true},
     {JointKind::slider, "slider", 2, 3, false, true},
     {JointKind::weld, "weld", 3, 3}}};

/// Throws std::invalid_argument, naming all kinds, for a number that is none.
const JointProperties& properties_of(JointKind kind);

inline std::string name_of(JointKind kind) {
  return properties_of(kind).name;
}

/// A spring and a damper on the free coordinate of a hinge or slider: -k (s - rest) - c ds/dt, on j. The step is stable
/// for any k and c: engine/constraints/joint_rows.hpp.
struct Spring {
  double stiffness = 0;  ///< k [N m/rad or N/m]
  double damping = 0;    ///< c [N m s/rad or N s/m]
  double rest = 0;       ///< angle [rad] or shift [m] at which the spring is relaxed
};

/// Throws std::invalid_argument, naming the parameter, unless stiffness and damping are finite and at least 0, one of
/// them is positive, and rest is finite.
void require_sound(const Spring& spring);

/// The description of a joint that is added to a world.
struct Joint {
  int i, j;                           ///< body indices, i ≠ j; not both static
  Vec3 p_i = Vec3::Zero();            ///< the point on i, in the axes of i [m]; zero for a point mass
  Vec3 p_j = Vec3::Zero();            ///< the point on j, in the axes of j [m]
  std::optional<double> length = {};  ///< length of a distance, or largest length of a rope [m]
  std::optional<double> k = {};       ///< stiffness [N/m]. Default: the world's
  std::optional<double> d = {};       ///< relaxation [steps]. Default: the world's

  JointKind kind = JointKind::ball;  ///< may be omitted for a distance, which has a length
  // The members below are for hinges, sliders and welds; limit_d is for ropes, too.
  Vec3 axis = Vec3::UnitZ();  ///< unit vector along the hinge or slider, in i's axes
  /// Orientation of j in i, q_i* q_j, at which the angle is 0. Default: the orientation when the joint is added.
  std::optional<Quat> rest = {};
  /// Stiffness of the angles that the joint holds [N m/rad]. Default: the value of k, if k is given.
  std::optional<double> k_turn = {};
  std::optional<JointLimits> limits = {};  ///< range of the angle [rad] or shift [m]
  /// Relaxation of a limit, or of a rope [steps]. Default: 3, which damps bouncing.
  std::optional<double> limit_d = {};
  std::optional<Spring> spring = {};
  std::optional<Motor> motor = {};
  /// The angle of a hinge after the last step, full turns included [rad]. Before the first step only its number of full
  /// turns matters.
  double angle = 0;
  /// Set by the world if k, k_turn follow masses and step.
  bool has_default_k = false, has_default_k_turn = false;
  /// Set by the world if its rows have recovered in the last step, engine/constraints/joint_recovery.hpp.
  bool recovered = false;
  /// Set by the world: the part of the motor row's λ that is the limit's, in the last step [N s or N m s].
  double taken_by_limit = 0;

  /// Tells whether the joint is a hinge, a slider or a weld.
  bool is_guided() const { return properties_of(kind).about > 0; }
  bool needs_length() const { return properties_of(kind).has_length; }
  bool has_free_axis() const { return properties_of(kind).has_free_axis; }
  /// The number of rows: the holding rows first, then one each for the limits, the spring, and the motor.
  int rows() const { return spring_row() + (spring ? 1 : 0) + (motor ? 1 : 0); }
  /// The index of the spring's row, if there is a spring.
  int spring_row() const { return holding_rows() + (limits ? 1 : 0); }
  int holding_rows() const;
  /// Tells whether a row holds an angle.
  bool turns(int row) const;
  /// The stiffness of a holding row, or of the limit's row [N/m or N m/rad]; infinite for the rows of spring and motor.
  double stiffness(int row) const;
};

/// The attachment of a joint to a body at its current position.
inline Attachment attachment(int body, const Vec3&, const Bodies<3>& bodies) {
  return {.body = body, .x = bodies.x[static_cast<std::size_t>(body)]};
}
inline Attachment attachment(int body, const Vec3& p, const Bodies<6>& bodies) {
  const auto b = static_cast<std::size_t>(body);
  return {.body = body, .x = bodies.x[b], .r = bodies.orientations.q[b] * p};
}

/// The distance of the joint's two points [m], rounded as in Eq. (6.2).
template <int Dof>
double distance(const Joint& joint, const Bodies<Dof>& bodies) {
  const Attachment i = attachment(joint.i, joint.p_i, bodies), j = attachment(joint.j, joint.p_j, bodies);
  return ((j.x + j.r) - (i.x + i.r)).norm();
}

/// The two current frames of a hinge, slider or weld. `rest` must be given.
struct JointFrames {
  JointFrame i, j;
};
JointFrames frames(const Joint& joint, const Bodies<6>& bodies);

/// The current free coordinate of a hinge or slider: the angle nearest to `joint.angle`, or the shift.
Coordinate free_coordinate(const Joint& joint, const Bodies<6>& bodies);

/// Position error of a joint: of its points [m], and of its angles [rad].
struct JointGap {
  Vec3 apart = Vec3::Zero(), turned = Vec3::Zero();
};
template <int Dof>
JointGap gap_of(const Joint& joint, const Bodies<Dof>& bodies);

}  // namespace spook
