#pragma once
// What a scene looks like, and what it looks like now: the content of a recording, in plain numbers.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/world/world.hpp"

namespace spook {

/// The look of a body.
struct Appearance {
  Shape shape = NoShape{};
  std::optional<Plane> plane = {};  ///< in place of a shape
  bool is_hand = false;             ///< what pulls at a body, which is not drawn
  bool is_static = false;
};

/// What does not change in a run.
struct Picture {
  std::vector<Appearance> bodies;
  std::vector<Joint> joints;
};

/// A contact of the last step.
struct Touch {
  int i, j;
  Vec3 point, n;  ///< [m]; from i to j
  double gap;     ///< [m]
  Vec3 impulse;   ///< on j, friction included [N s]
};

/// Where the energy is [J]. That of half a step ago, as v is, and x - h v/2 for it; of now, where steps are composed.
struct Energy {
  double motion = 0, turning = 0;
  double weight = 0;  ///< 0 at the height of the origin
  double field = 0;   ///< of forces beside the weight
  /// What springs as stiff as contacts and joints hold under the forces of the last step, ½ (λ/h)²/k. ½ k gap² would not
  /// do: where k h² is far beyond the masses, a gap is what the step leaves, and no spring's.
  double springs = 0;
};

/// A look at a world.
struct Frame {
  double time = 0;  ///< [s]
  std::int64_t step = 0;
  std::vector<Vec3> x, v;              ///< [m, m/s]
  std::vector<Quat> q;                 ///< of rigid bodies only
  std::vector<Vec3> omega;             ///< of rigid bodies only [rad/s]
  std::vector<Touch> contacts;         ///< of the last step
  std::vector<double> joint_impulses;  ///< of each row of the joints, in the last step [N s]
  Energy energy;
};

/// Where the answer says that a body should be, and how a rigid one should be turned.
struct Ghost {
  int body;
  Vec3 x;  ///< [m]
  Quat q = Quat::Identity();
};

/// A line on which the answer lies.
struct Curve {
  std::string name;
  std::vector<Vec3> points;  ///< [m]
};

/// 200 points of `x`, which belong to numbers from `from` to `to`.
template <class Function>
Curve curve(std::string name, double from, double to, const Function& x) {
  Curve line{.name = std::move(name), .points = {}};
  for (int n = 0; n <= 200; ++n) line.points.push_back(x(from + (to - from) * n / 200));
  return line;
}

template <int Dof>
Picture picture_of(const World<Dof>& world);

/// `h` is that of the last step [s].
template <int Dof>
Frame frame_of(const World<Dof>& world, double h);

}  // namespace spook
