#pragma once
// Parts of mechanisms: rods, and joints given by a point and an axis in the world.
#include "engine/world/world.hpp"
#include "scenes/natural_coordinates.hpp"
#include "scenes/parameters.hpp"
#include "scenes/reference_motion.hpp"

namespace spook {

/// A uniform rod of square cross-section, at rest. Its x axis is along the rod, and its y axis along `across`, a unit
/// vector perpendicular to the rod.
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

/// A uniform rod of no thickness. Moments must be positive, so its moment about its own line is a thousandth of that
/// across the line. This has no effect if the rod does not rotate about its line.
inline Body<6> thin_rod(const Vec3& from, const Vec3& to, const Vec3& across, double mass) {
  Body<6> thin = rod(from, to, across, mass, 0);
  thin.principal = mass * (to - from).squaredNorm() / 12 * Vec3(1e-3, 1, 1);
  return thin;
}

/// A joint of two bodies at their current positions, with its point, and the axis of a hinge or slider, in the world.
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

/// The motion in natural coordinates, accurate to round-off; constraints are satisfied after each step.
using NaturalMotion = ReferenceMotion<Eigen::Dynamic>;
inline NaturalMotion motion_of(const NaturalCoordinates& mechanism) {
  return NaturalMotion([mechanism](const Eigen::VectorXd& y) { return mechanism.rate(y); }, mechanism.start(),
                       1e-12, [mechanism](const Eigen::VectorXd& y) { return mechanism.projected(y); });
}

namespace parameter {

/// The stiffness of the joints of mechanisms: so large that the joints' compliance is smaller than the error of a step.
inline Parameter stiff_joints(double k) {
  Parameter stiffness = parameter::stiffness();
  stiffness.value = k;
  return stiffness;
}

/// The relaxation of swinging joints; set it to 0 for steps of order four.
inline Parameter relaxation_of_swinging_joints() {
  Parameter relaxation = parameter::relaxation();
  relaxation.value = 0.25;
  return relaxation;
}

}  // namespace parameter

}  // namespace spook
