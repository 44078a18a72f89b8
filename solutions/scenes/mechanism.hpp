#pragma once
// What scenes of mechanisms are built from: rods, and joints said by a place and an axis in the world.
#include "engine/world/world.hpp"
#include "scenes/natural_coordinates.hpp"
#include "scenes/parameters.hpp"
#include "scenes/reference_motion.hpp"

namespace spook {

/// A uniform rod of square cross-section, at rest; its own x axis is along it and its y axis along `across`, which is at
/// right angles to it.
inline Body<6> rod(const Vec3& from, const Vec3& to, const Vec3& across, double mass, double thickness) {
  const Vec3 along = (to - from).normalized();
  Mat3 axes;
  axes << along, across, along.cross(across);
  const double l2 = (to - from).squaredNorm(), t2 = thickness * thickness;
  return {.x = (from + to) / 2,
          .mass = mass,
          .q = Quat(axes),
          .principal = mass / 12 * Vec3(2 * t2, l2 + t2, l2 + t2)};
}

/// A uniform rod whose mass is all on its line. About that line it has a thousandth of the moment that it has across, for
/// a body must have one; it is of no account where nothing turns it about itself.
inline Body<6> thin_rod(const Vec3& from, const Vec3& to, const Vec3& across, double mass) {
  Body<6> thin = rod(from, to, across, mass, 0);
  thin.principal = mass * (to - from).squaredNorm() / 12 * Vec3(1e-3, 1, 1);
  return thin;
}

/// A joint of two bodies as they are, at a place in the world; for a hinge or slider with an axis, in the world, too.
inline Joint joint_at(const World<6>& world, JointKind kind, int i, int j, const Vec3& place,
                      const Vec3& axis = Vec3::UnitZ()) {
  const auto seen = [&](int body, const Vec3& v) { return Vec3(orientation(world, body).conjugate() * v); };
  return {.i = i,
          .j = j,
          .p_i = seen(i, place - world.x(i)),
          .p_j = seen(j, place - world.x(j)),
          .kind = kind,
          .axis = seen(i, axis)};
}

/// The motion of natural coordinates, to roundings; what is held is held after each step of it.
using NaturalMotion = ReferenceMotion<Eigen::Dynamic>;
inline NaturalMotion motion_of(const NaturalCoordinates& mechanism) {
  return NaturalMotion([mechanism](const Eigen::VectorXd& y) { return mechanism.rate(y); }, mechanism.start(),
                       1e-12, [mechanism](const Eigen::VectorXd& y) { return mechanism.projected(y); });
}

namespace parameter {

/// Of the joints of mechanisms: stiff, so that their own give is less than what a step leaves.
inline Parameter stiff_joints(double k) {
  Parameter stiffness = parameter::stiffness();
  stiffness.value = k;
  return stiffness;
}

/// Of joints that swing; 0 for steps that are composed.
inline Parameter relaxation_of_swinging_joints() {
  Parameter relaxation = parameter::relaxation();
  relaxation.value = 0.25;
  return relaxation;
}

}  // namespace parameter

}  // namespace spook
