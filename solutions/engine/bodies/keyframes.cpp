#include "engine/bodies/keyframes.hpp"

#include <algorithm>

#include "common/require.hpp"
#include "engine/bodies/bodies.hpp"

namespace spook {

Keyframes::Keyframes(std::vector<Keyframe> frames) : frames_(std::move(frames)) {
  if (frames_.empty()) throw std::invalid_argument("keyframes must be at least one, but are none");
  for (std::size_t n = 0; n < frames_.size(); ++n) {
    Keyframe& frame = frames_[n];
    require_finite("time", frame.time);
    if (n > 0 && !(frame.time > frames_[n - 1].time))
      reject("time", frame.time,
             "later than that of the keyframe before, which is " + std::to_string(frames_[n - 1].time));
    require_all_finite("x", frame.x);
    require_unit_length("q", frame.q.norm());
    frame.q.normalize();
  }
}

Keyframe Keyframes::at(double time) const {
  const auto later = std::upper_bound(frames_.begin(), frames_.end(), time,
                                      [](double t, const Keyframe& frame) { return t < frame.time; });
  if (later == frames_.begin()) return {.time = time, .x = frames_.front().x, .q = frames_.front().q};
  if (later == frames_.end()) return {.time = time, .x = frames_.back().x, .q = frames_.back().q};
  const Keyframe &from = *(later - 1), &to = *later;
  const double part = (time - from.time) / (to.time - from.time);
  return {.time = time, .x = (1 - part) * from.x + part * to.x, .q = from.q.slerp(part, to.q)};
}

Vec3 angular_velocity_between(const Quat& from, const Quat& to, double h) {
  const Eigen::AngleAxisd turn(to * from.conjugate());
  return turn.angle() / h * turn.axis();
}

}  // namespace spook
