#pragma once
// The types that all chapters use. SI units and world coordinates, unless a comment says otherwise.
// A NaN stays a NaN, and a comparison with a NaN is false: chapters/NUMBERS.md.
// The result of a function depends on its arguments only, and not on units. Functions do not change const arguments,
// nor masses and Jacobians.
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace spook {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// A quaternion, written (w, x, y, z). Beware: `Quat(w, x, y, z)` constructs in that order, but Eigen stores and
/// prints `coeffs()` as (x, y, z, w).
using Quat = Eigen::Quaterniond;

/// Velocity, or a Jacobian block, of one body: 3 numbers for a point mass, 6 (linear, then angular) for a rigid
/// body.
template <int Dof>
using Twist = Eigen::Matrix<double, Dof, 1>;

/// Builds the six numbers of a rigid body from two vectors. They are written two at a time, as they are read: a
/// processor that reads a pair written in two pieces waits for the cache.
inline Twist<6> twist(const Vec3& linear, const Vec3& angular) {
  Twist<6> both;
  both.segment<2>(0) = Eigen::Vector2d(linear[0], linear[1]);
  both.segment<2>(2) = Eigen::Vector2d(linear[2], angular[0]);
  both.segment<2>(4) = Eigen::Vector2d(angular[1], angular[2]);
  return both;
}

}  // namespace spook
