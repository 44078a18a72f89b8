#pragma once
// A scene in the words that every engine understands: bodies, shapes, joints, and how they begin.
//
// It is read off our own world, which a scene's name or a JSON file has made: so all engines get the same numbers.
// Velocities are those of half a step before the positions, as in the file: every engine here steps
// v += h a, then x += h v, and is of second order where it starts like this, and of first order where it does not.
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
  Vec3 principal = Vec3::Zero();   ///< [kg m²]; of a point mass those of a small ball, which never turns
  double radius = 0;               ///< of its sphere [m], or 0
  Vec3 half_sides = Vec3::Zero();  ///< of its box [m], or 0
};

struct Problem {
  Vec3 gravity;
  double friction = 0;
  double restitution = 0, threshold = 0;  ///< e, and the slowest approach that bounces [m/s]
  std::vector<ProblemBody> bodies = {};   ///< in the scene's order; that of a plane has no shape
  std::vector<Plane> planes = {};
  std::vector<Joint> joints = {};
};

/// What a scene begins with. Throws std::invalid_argument for one whose force is a formula, which no file can hold
/// either, and for corners that are not those of a box.
Problem problem_of(const Scene& scene);

}  // namespace spook::peers
