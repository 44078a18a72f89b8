#pragma once
// Bodies, as arrays: entry i of each belongs to body i.
//
//   Dof 3   a point mass: position and velocity. Nothing that turns is stored or computed.
//   Dof 6   a rigid body: orientation, angular velocity and moments of inertia, too.
//
//   x   centre of mass [m]                           W   velocity: v, then ω, in world coordinates [m/s, rad/s]
//   q   orientation, body to world, (w, x, y, z)     M   mass [kg], and moments about the body's own axes [kg m²]
//
// A fixed body has inverse mass zero: nothing moves it, and every formula holds for it as for the others.
#include <optional>
#include <vector>

#include "04_gauss_seidel/gauss_seidel.hpp"
#include "engine/bodies/orientations.hpp"

namespace spook {

/// One body as it is handed to a world, at time 0.
template <int Dof>
struct Body;

template <>
struct Body<3> {
  Vec3 x = Vec3::Zero();  ///< [m]
  Vec3 v = Vec3::Zero();  ///< [m/s]
  double mass = 1;        ///< [kg]
  double radius = 0;      ///< of its sphere [m]; 0: it has no shape and touches nothing
};

template <>
struct Body<6> {
  Vec3 x = Vec3::Zero();      ///< centre of mass [m]
  Vec3 v = Vec3::Zero();      ///< [m/s]
  double mass = 1;            ///< [kg]
  double radius = 0;          ///< of its sphere [m]; 0: it has no shape and touches nothing
  Quat q = Quat::Identity();  ///< body to world, of unit length
  Vec3 omega = Vec3::Zero();  ///< angular velocity, in world coordinates [rad/s]
  std::optional<Vec3> principal =
      {};  ///< moments of inertia about the body's own axes [kg m²]; a solid sphere or box
           ///< knows them, and any other body must say
  Vec3 half_sides = Vec3::Zero();  ///< of its box, along the body's axes [m]; instead of a sphere
  std::vector<Vec3> corners = {};  ///< points of it that a plane stops, in the body's axes from its centre [m];
                                   ///< instead of either
};

/// The principal moments of a solid sphere, 2/5 m r² each [kg m²].
Vec3 solid_sphere_moments(double mass, double radius);

/// The principal moments of a solid box, m/3 (b² + c²) and so on [kg m²], and its eight corners [m], from the
/// halves of its sides (a, b, c) [m].
Vec3 solid_box_moments(double mass, const Vec3& half_sides);
std::vector<Vec3> box_corners(const Vec3& half_sides);

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

  /// Adds a body that nothing moves.
  int add_fixed(const Vec3& position);

  /// Takes a body out; those after it move up by one.
  void remove(std::size_t i);
};

/// Throws std::invalid_argument unless |v| = 1, to 1e-9.
void require_unit_length(const std::string& name, double length);

}  // namespace spook
