#pragma once
// The few types that every chapter speaks in. SI units and world coordinates, unless a comment says otherwise.
// A NaN stays a NaN, and a question about one is answered by no: chapters/NUMBERS.md.
// Of every function: its answer depends on its arguments alone, and not on the units they are counted in; what is given
// as const, and masses and Jacobians that are handed in, stay as they were.
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

/// A rigid body's, of its two parts. Written two numbers at a time, as it will be read: a processor that reads two which
/// were written in two pieces waits until both are in its cache.
inline Twist<6> twist(const Vec3& linear, const Vec3& angular) {
  Twist<6> both;
  both.segment<2>(0) = Eigen::Vector2d(linear[0], linear[1]);
  both.segment<2>(2) = Eigen::Vector2d(linear[2], angular[0]);
  both.segment<2>(4) = Eigen::Vector2d(angular[1], angular[2]);
  return both;
}

}  // namespace spook
