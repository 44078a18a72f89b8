#pragma once
// Shared by this chapter's tests: turns with known answers, and comparison of rotations.
#include "02_quaternions/quaternions.hpp"
#include "checks.hpp"

namespace spook::testing {

using Vec4 = Eigen::Vector4d;

/// (w, x, y, z), as the chapter writes it; Eigen's own coeffs() are (x, y, z, w).
inline Vec4 coefficients(const Quat& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}

/// Eq. (2.6), written out: the quaternion that turns by `angle` [rad] about the unit vector `axis`.
inline Quat turn_about(const Vec3& axis, double angle) {
  const Vec3 v = std::sin(angle / 2) * axis;
  return {std::cos(angle / 2), v.x(), v.y(), v.z()};
}

/// Multiplies all four coefficients, as in ½ a b.
inline Quat scaled(double factor, const Quat& q) {
  return Quat(Vec4(factor * q.coeffs()));
}

/// The signed angle [rad], in (-π, π], by which `to` is turned from `from` about the unit vector `axis` (world).
inline double angle_about(const Vec3& axis, const Quat& from, const Quat& to) {
  const Quat turn = to * from.conjugate();
  const double half_angle = std::atan2(turn.vec().dot(axis), turn.w());
  return std::remainder(2 * half_angle, 4 * std::acos(0.0));
}

/// Compares (w, x, y, z) as expect_near_vector does, except that q and -q are the same rotation. A length other
/// than 1 counts as a difference.
inline void expect_same_rotation(const std::string& what, const std::string& equation, const Quat& got,
                                 const Quat& expected, const Tolerance& tolerance,
                                 const std::vector<Clue<Quat>>& clues = {}, const std::string& otherwise = "") {
  const auto aligned = [&](const Quat& q) -> Vec4 { return (q.dot(expected) < 0 ? -1 : 1) * coefficients(q); };
  const double close = std::max(10 * tolerance.value, 1e-9);
  for (const Clue<Quat>& known : clues)
    if ((aligned(got) - aligned(known.wrong)).norm() <= close) {
      expect_near_vector<Vec4>(what, equation, aligned(got), coefficients(expected), tolerance, {}, known.text);
      return;
    }
  expect_near_vector<Vec4>(what, equation, aligned(got), coefficients(expected), tolerance, {}, otherwise);
}

}  // namespace spook::testing
