#pragma once
// Keyframes: where a kinematic body is at given times.
//
// Between two keyframes the position is linear in time, and the orientation turns about one axis at a constant rate, by
// the shorter way (slerp). Before the first keyframe and after the last one the body stands still.
#include <vector>

#include "common/types.hpp"

namespace spook {

struct Keyframe {
  double time;                ///< [s]
  Vec3 x;                     ///< [m]
  Quat q = Quat::Identity();  ///< body to world, of unit length; point masses have none
};

class Keyframes {
 public:
  /// Throws std::invalid_argument, naming the parameter, unless there is a keyframe, times are finite and increase,
  /// positions are finite, and orientations are of unit length.
  explicit Keyframes(std::vector<Keyframe> frames);

  /// Returns the position and orientation at a time [s].
  Keyframe at(double time) const;

  const std::vector<Keyframe>& frames() const { return frames_; }

 private:
  std::vector<Keyframe> frames_;
};

/// Returns the constant angular velocity, in world coordinates [rad/s], that turns `from` into `to` in `h` [s], by the
/// shorter way.
Vec3 angular_velocity_between(const Quat& from, const Quat& to, double h);

}  // namespace spook
