#pragma once
// A simulation in plain data. The step of a chapter, its last exercise, advances it by h.
//
//   02 step_free      free bodies                    06 step_joints    adds joints
//   03 step_touching  one contact                    07 step_impacts   adds impacts
//   04 step_contacts  many contacts                  08 step_pairs     finds the contacts
//   05 step_friction  adds friction                  09 step_rows      half a step: any solver may follow
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
  double mass = 0;            ///< [kg]; 0 is a static body
  /// Principal moments of inertia [kg m²]; zero: a point mass, which does not turn.
  Vec3 principal = Vec3::Zero();

  double radius = 0;               ///< radius of its ball [m]; 0: no ball
  Vec3 half_sides = Vec3::Zero();  ///< half sides of its box [m]; zero: no box
  Vec3 normal = Vec3::Zero();      ///< outward unit normal of its plane; zero: no plane
  double offset = 0;               ///< offset of its plane along the normal, from the world's origin [m]
};

/// Joint that keeps two points of two bodies at one place, or at a distance.
struct PointJoint {
  int i, j;                ///< body indices, i ≠ j
  Vec3 p_i, p_j;           ///< the points relative to the centres, in body axes [m]
  double length = 0;       ///< distance [m]; 0: a ball joint
  double k = 1, d = 0.25;  ///< stiffness [N/m] and relaxation [steps]
};

struct Simulation {
  std::vector<RigidBody> bodies;
  std::vector<PointJoint> joints = {};
  Vec3 gravity = Vec3(0, 0, -9.81);  ///< [m/s²]
  double k = 1e6, d = 3;             ///< stiffness [N/m] and relaxation [steps] of contacts
  double mu = 0;                     ///< friction coefficient; 0: no friction rows
  double viscosity = 1e12;           ///< c of a friction row [N s/m]
  double restitution = 0;            ///< e of an impact, 0 to 1; 0: no impacts, as rows do not bounce
  int max_sweeps = 50;               ///< largest number of sweeps in a step
  double tolerance = 0;              ///< bound for the value that a sweep returns [m/s]
};

}  // namespace spook
