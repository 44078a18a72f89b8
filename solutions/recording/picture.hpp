#pragma once
// The content of a recording in plain numbers: the appearance of a scene, and its frames.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/world/world.hpp"

namespace spook {

/// The appearance of a body.
struct Appearance {
  Shape shape = NoShape{};
  std::optional<Plane> plane = {};  ///< in place of a shape
  bool is_hand = false;             ///< the static end of a pull, which is not drawn
  bool is_static = false;
};

/// The part of a recording that is constant during a run.
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

/// Energies [J]. They belong to the time half a step ago, since v does; x - h v/2 is the position at that time. At
/// order 4 they belong to the current time.
struct Energy {
  double motion = 0, turning = 0;
  double weight = 0;   ///< 0 at the height of the origin
  double field = 0;    ///< of forces other than the weight
  double springs = 0;  ///< spring_energy()
};

/// The state of a world at one time.
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

/// The position, and orientation of a rigid body, in the answer.
struct Ghost {
  int body;
  Vec3 x;  ///< [m]
  Quat q = Quat::Identity();
};

/// A curve of the answer, such as a trajectory.
struct Curve {
  std::string name;
  std::vector<Vec3> points;  ///< [m]
};

/// Returns the curve of `x` at 201 arguments, equally spaced from `from` to `to`.
template <class Function>
Curve curve(std::string name, double from, double to, const Function& x) {
  Curve line{.name = std::move(name), .points = {}};
  for (int n = 0; n <= 200; ++n) line.points.push_back(x(from + (to - from) * n / 200));
  return line;
}

template <int Dof>
Picture picture_of(const World<Dof>& world);

/// Returns the current frame of a world. `h`: the last step [s].
template <int Dof>
Frame frame_of(const World<Dof>& world, double h);

}  // namespace spook
