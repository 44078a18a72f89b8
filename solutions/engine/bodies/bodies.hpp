#pragma once
// Bodies, as arrays: entry i of each belongs to body i.
//
//   Dof 3   a point mass: position and velocity. Nothing that turns is stored or computed.
//   Dof 6   a rigid body: orientation, angular velocity and moments of inertia, too.
//
//   x   centre of mass [m]                           W   velocity: v, then ω, in world coordinates [m/s, rad/s]
//   q   orientation, body to world, (w, x, y, z)     M   mass [kg], and moments about the body's own axes [kg m²]
//
// A static body has inverse mass zero: nothing moves it, and every formula holds for it as for the others.
#include <optional>
#include <vector>

#include "04_gauss_seidel/gauss_seidel.hpp"
#include "engine/bodies/orientations.hpp"
#include "engine/bodies/shape.hpp"

namespace spook {

/// A body as it is handed to a world, at time 0.
template <int Dof>
struct Body;

template <>
struct Body<3> {
  Vec3 x = Vec3::Zero();  ///< [m]
  Vec3 v = Vec3::Zero();  ///< [m/s]
  double mass = 1;        ///< [kg]
  double radius = 0;      ///< of its sphere [m]; 0: it has no shape and touches nothing
};

/// Has a shape by one of radius, radius and half_length, half_sides, and corners; without them it touches nothing.
template <>
struct Body<6> {
  Vec3 x = Vec3::Zero();      ///< centre of mass [m]
  Vec3 v = Vec3::Zero();      ///< [m/s]
  double mass = 1;            ///< [kg]
  double radius = 0;          ///< of its sphere or capsule [m]
  Quat q = Quat::Identity();  ///< body to world, of unit length
  Vec3 omega = Vec3::Zero();  ///< angular velocity, in world coordinates [rad/s]
  /// Moments of inertia about the body's own axes [kg m²]. Default: those of a solid sphere, capsule or box; any other
  /// body must say.
  std::optional<Vec3> principal = {};
  double half_length = 0;          ///< of the segment of its capsule, along the body's z axis [m]
  Vec3 half_sides = Vec3::Zero();  ///< of its box, along the body's axes [m]
  std::vector<Vec3> corners = {};  ///< points that a plane stops, in the body's axes from its centre [m]
};

/// Returns the shape that a body's numbers tell. Throws std::invalid_argument where they tell two, or one that is not
/// sound.
template <int Dof>
Shape shape_of(const Body<Dof>& body);

template <int Dof>
struct Bodies {
  std::vector<Vec3> x;                                   ///< [m]
  Motion<Dof> motion;                                    ///< inverse masses and velocities
  std::vector<double> mass;                              ///< [kg]; 0 for a fixed body
  [[no_unique_address]] Orientations<Dof> orientations;  ///< nothing at all for point masses

  std::size_t size() const { return x.size(); }
  bool is_fixed(std::size_t i) const { return mass[i] == 0; }

  /// Adds a body and returns its index. Throws std::invalid_argument for a number that is not finite, a mass or
  /// moment that is not positive, moments of which one is more than the other two together, which no body has, a rigid
  /// body without moments whose shape does not tell them, and an orientation that is not of unit length.
  int add(const Body<Dof>& body);

  /// Adds a static body.
  int add_fixed(const Vec3& position);

  /// Takes a body out; those after it move up by one.
  void remove(std::size_t i);
};

/// Throws std::invalid_argument unless |v| = 1, to 1e-9.
void require_unit_length(const std::string& name, double length);

}  // namespace spook
