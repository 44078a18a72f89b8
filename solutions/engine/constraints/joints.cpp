#include "engine/constraints/joints.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "common/require.hpp"

namespace spook {

static_assert(
    [] {
      for (std::size_t n = 0; n < joint_properties.size(); ++n)
        if (static_cast<std::size_t>(joint_properties[n].kind) != n) return false;
      return true;
    }(),
    "joint_properties must be in the order of JointKind");

const JointProperties& properties_of(JointKind kind) {
  const auto n = static_cast<std::size_t>(kind);
  if (n < joint_properties.size()) return joint_properties[n];
  std::string names;
  for (const JointProperties& known : joint_properties)
    names += std::string(names.empty() ? "" : ", ") + known.name;
  throw std::invalid_argument("kind of joint must be one of " + names + ", but is number " +
                              std::to_string(static_cast<int>(kind)));
}

namespace {

/// Returns the smallest rotation from z to a unit vector.
Quat turn_of_z_to(const Vec3& axis) {
  if (axis.z() < -1 + 1e-12) return Quat(0, 1, 0, 0);  // half a turn, about any perpendicular axis
  const double s = std::sqrt(2 * (1 + axis.z()));
  return Quat(s / 2, -axis.y() / s, axis.x() / s, 0);
}

}  // namespace

void require_sound(const Spring& spring) {
  require_not_negative("stiffness", spring.stiffness);
  require_not_negative("damping", spring.damping);
  if (spring.stiffness == 0 && spring.damping == 0) reject("stiffness", 0, "positive where damping is 0");
  require_finite("rest", spring.rest);
}

int Joint::holding_rows() const {
  const JointProperties& of_kind = properties_of(kind);
  return of_kind.along + of_kind.about;
}

bool Joint::turns(int row) const {
  if (row >= holding_rows()) return kind == JointKind::hinge;
  return row >= properties_of(kind).along;
}

double Joint::stiffness(int row) const {
  if (row >= spring_row()) return infinity;
  return turns(row) ? *k_turn : *k;
}

JointFrames frames(const Joint& joint, const Bodies<6>& bodies) {
  const auto i = static_cast<std::size_t>(joint.i), j = static_cast<std::size_t>(joint.j);
  const Quat c = turn_of_z_to(joint.axis.normalized());
  const std::vector<Quat>& q = bodies.orientations.q;
  return {.i = {attachment(joint.i, joint.p_i, bodies), q[i] * c},
          .j = {attachment(joint.j, joint.p_j, bodies), q[j] * joint.rest->conjugate() * c}};
}

Coordinate free_coordinate(const Joint& joint, const Bodies<6>& bodies) {
  const JointFrames at = frames(joint, bodies);
  return joint.kind == JointKind::slider ? shift_along(at.i, at.j, 2) : hinge_angle(at.i, at.j, joint.angle);
}

template <int Dof>
JointGap gap_of(const Joint& joint, const Bodies<Dof>& bodies) {
  const Attachment i = attachment(joint.i, joint.p_i, bodies), j = attachment(joint.j, joint.p_j, bodies);
  JointGap gap{.apart = (j.x + j.r) - (i.x + i.r)};
  if (joint.length) {
    const double apart = gap.apart.norm();
    const double off =
        joint.kind == JointKind::rope ? std::max(apart - *joint.length, 0.0) : apart - *joint.length;
    gap.apart = off * gap.apart.normalized();
  }
  if constexpr (Dof == 6)
    if (joint.is_guided()) {
      const JointFrames at = frames(joint, bodies);
      const std::array<Coordinate, 3> turned = turned_apart(at.i, at.j);
      for (std::size_t axis = 0; axis < turned.size(); ++axis)
        if (axis < 2 || joint.kind != JointKind::hinge)
          gap.turned[static_cast<Eigen::Index>(axis)] = turned[axis].value;
      const Vec3 along = at.i.axes * Vec3::UnitZ();
      if (joint.kind == JointKind::slider) gap.apart -= along.dot(gap.apart) * along;
    }
  return gap;
}

template JointGap gap_of<3>(const Joint&, const Bodies<3>&);
template JointGap gap_of<6>(const Joint&, const Bodies<6>&);

}  // namespace spook
