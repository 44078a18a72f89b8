#pragma once
// Bodies, as arrays: entry i of each belongs to body i.
//
//   Dof 3   a point mass: position and velocity, without orientation and torque
//   Dof 6   a rigid body: also orientation, angular velocity and moments of inertia
//
//   x   centre of mass [m]                           W   velocity: v, then ω, in world coordinates [m/s, rad/s]
//   q   orientation, body to world, (w, x, y, z)     M   mass [kg], and moments about the body's own axes [kg m²]
//
// A static body has inverse mass zero, so all formulas hold for it, too.
#include <optional>
#include <vector>

#include "04_gauss_seidel/gauss_seidel.hpp"
#include "engine/bodies/orientations.hpp"
#include "engine/bodies/shape.hpp"

namespace spook {

/// The description of a body that is added to a world, at time 0.
template <int Dof>
struct Body;

template <>
struct Body<3> {
  Vec3 x = Vec3::Zero();  ///< [m]
  Vec3 v = Vec3::Zero();  ///< [m/s]
  double mass = 1;        ///< [kg]
  double radius = 0;      ///< of its sphere [m]; 0: no shape and no contacts
};

/// The description of a rigid body. Its shape is given by one of radius, radius and half_length, half_sides, and
/// corners; a body with none of them has no contacts.
template <>
struct Body<6> {
  Vec3 x = Vec3::Zero();      ///< centre of mass [m]
  Vec3 v = Vec3::Zero();      ///< [m/s]
  double mass = 1;            ///< [kg]
  double radius = 0;          ///< of its sphere or capsule [m]
  Quat q = Quat::Identity();  ///< body to world, of unit length
  Vec3 omega = Vec3::Zero();  ///< angular velocity, in world coordinates [rad/s]
  /// Moments of inertia about the body's own axes [kg m²]. Default: those of a solid sphere, capsule or box. Other
  /// bodies have no default.
  std::optional<Vec3> principal = {};
  double half_length = 0;          ///< of the capsule's segment, along the body's z axis [m]
  Vec3 half_sides = Vec3::Zero();  ///< of the box, along the body's axes [m]
  std::vector<Vec3> corners = {};  ///< points that touch planes only, from the centre in the body's axes [m]
};

/// Returns the shape that a body's numbers describe. Throws std::invalid_argument if they describe two shapes, or an
/// invalid one.
template <int Dof>
Shape shape_of(const Body<Dof>& body);

template <int Dof>
struct Bodies {
  std::vector<Vec3> x;                                   ///< [m]
  Motion<Dof> motion;                                    ///< inverse masses and velocities
  std::vector<double> mass;                              ///< [kg]; 0 for a static body
  [[no_unique_address]] Orientations<Dof> orientations;  ///< empty for point masses

  std::size_t size() const { return x.size(); }
  bool is_fixed(std::size_t i) const { return mass[i] == 0; }

  /// Adds a body and returns its index. Throws std::invalid_argument for a number that is not finite, a mass or moment
  /// that is not positive, a moment larger than the sum of the other two, missing moments of a body whose shape has no
  /// default, and an orientation that is not of unit length.
  int add(const Body<Dof>& body);

  /// Adds a static body.
  int add_fixed(const Vec3& position);

  /// Removes a body. The indices of later bodies decrease by one.
  void remove(std::size_t i);
};

/// Throws std::invalid_argument, naming `name`, unless `length` is 1 within 1e-9.
void require_unit_length(const std::string& name, double length);

}  // namespace spook
