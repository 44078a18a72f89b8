#pragma once
// A scene as data for all engines: bodies, shapes, joints, and their initial state.
//
// The data are read from a world of ours, which a scene's name or a JSON file defines, so all engines get the same
// numbers. Velocities belong to half a step before the positions, as in the file. Every engine here steps v += h a,
// then x += h v. So it is of second order with this start, and of first order with another.
#include <optional>
#include <vector>

#include "scenes/scene.hpp"

namespace spook::peers {

struct ProblemBody {
  bool moves = false;
  Vec3 x = Vec3::Zero(), v = Vec3::Zero();  ///< [m], [m/s]
  Quat q = Quat::Identity();                ///< body to world
  Vec3 omega = Vec3::Zero();                ///< in world coordinates [rad/s]
  double mass = 0;                          ///< [kg]
  Vec3 principal = Vec3::Zero();   ///< [kg m²]; for a point mass those of a small ball that never rotates
  double radius = 0;               ///< of a sphere [m], or 0
  Vec3 half_sides = Vec3::Zero();  ///< of a box [m], or 0
};

struct Problem {
  Vec3 gravity;
  double friction = 0;
  double restitution = 0, threshold = 0;  ///< e, and the smallest approach speed that bounces [m/s]
  std::vector<ProblemBody> bodies = {};   ///< in the scene's order; a plane's body has no shape
  std::vector<Plane> planes = {};
  std::vector<Joint> joints = {};
};

/// Returns the initial state of a scene. Throws std::invalid_argument for a force that is a formula, which a file
/// cannot hold either, and for corners other than those of a box.
Problem problem_of(const Scene& scene);

/// The same of a world without a scene.
Problem problem_of(const World<6>& world);

}  // namespace spook::peers
