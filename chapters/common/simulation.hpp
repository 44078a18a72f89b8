#pragma once
// A simulation in plain data: what the last exercise of a chapter, its step, moves on by h.
//
//   02 step_free      bodies fly and turn            06 step_joints    and hold together
//   03 step_touching  one contact pushes             07 step_impacts   and bounce
//   04 step_contacts  many contacts push             08 step_pairs     and find their contacts themselves
//   05 step_friction  and rub
//
// The step of chapter 01 is leapfrog_step: point masses in a field of force, with Particles for data.
#include <vector>

#include "common/types.hpp"

namespace spook {

/// A rigid body, or a point mass, with at most one shape.
struct RigidBody {
  Vec3 x = Vec3::Zero();      ///< centre of mass at t_n [m]
  Vec3 v = Vec3::Zero();      ///< velocity at t_n - h/2 [m/s]
  Quat q = Quat::Identity();  ///< orientation at t_n, body to world
  Vec3 omega = Vec3::Zero();  ///< angular velocity at t_n - h/2, in the world [rad/s]
  double mass = 0;            ///< [kg]; 0 is a static body, which stays where it is
  Vec3 principal =
      Vec3::Zero();  ///< principal moments of inertia [kg m²]; zero is a point mass, which does not turn

  double radius = 0;               ///< of its ball [m]; 0: no ball
  Vec3 half_sides = Vec3::Zero();  ///< of its box [m]; zero: no box
  Vec3 normal = Vec3::Zero();      ///< of its plane, a unit vector outwards; zero: no plane
  double offset = 0;               ///< of its plane along the normal, from the world's origin [m]
};

/// Holds two points of two bodies together, or at a length from each other.
struct PointJoint {
  int i, j;                ///< body indices, i ≠ j
  Vec3 p_i, p_j;           ///< the points, in the axes of their bodies from their centres [m]
  double length = 0;       ///< [m]; 0 is a ball joint
  double k = 1, d = 0.25;  ///< stiffness [N/m] and relaxation [steps]
};

struct Simulation {
  std::vector<RigidBody> bodies;
  std::vector<PointJoint> joints = {};
  Vec3 gravity = Vec3(0, 0, -9.81);  ///< [m/s²]
  double k = 1e6, d = 3;             ///< of contacts: stiffness [N/m] and relaxation [steps]
  double mu = 0;                     ///< friction coefficient; 0: no friction rows
  double viscosity = 1e12;           ///< c of a friction row [N s/m]
  double restitution = 0;            ///< e of an impact, 0 to 1; 0: no impacts, as rows do not bounce
  int max_sweeps = 50;               ///< at most, in a step
  double tolerance = 0;              ///< on what a sweep returns [m/s]
};

}  // namespace spook
