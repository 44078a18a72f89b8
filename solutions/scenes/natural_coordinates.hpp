#pragma once
// Mechanisms in natural coordinates: points and unit vectors that neighbours share. Nothing turns, so nothing is like the
// engine: no orientations, no angular velocities, no joints.
//
//   q      places of points [m], and unit vectors fixed to bodies, three numbers each
//   T      ½ q'ᵀ M q', M constant: a body is m at its centre and a second moment along each of its three axes
//   held   (a - b)·(c - d) = constant, for points or vectors a, b, c, d: lengths, right angles, unit lengths
//
//   M q'' + Gᵀ μ = Q,   G q'' = -2 (a' - b')·(c' - d')                  index 1; rows may repeat each other
//
// Where two bodies share a point they have a ball joint; where they share a vector, too, a hinge.
//
// Source: J. García de Jalón and E. Bayo, Kinematic and Dynamic Simulation of Multibody Systems, Springer 1994.
#include <vector>

#include <Eigen/Dense>

#include "common/types.hpp"

namespace spook {

class NaturalCoordinates {
 public:
  using Vector = Eigen::VectorXd;

  /// A point or a vector: the number of one that moves, or none for one that stays where it is.
  struct Place {
    int moving = -1;
    Vec3 fixed = Vec3::Zero();
  };

  /// Adds one that moves, where it is at time 0, with its velocity.
  Place add(const Vec3& x, const Vec3& v = Vec3::Zero());
  static Place fixed(const Vec3& x) { return {.fixed = x}; }

  /// From now on (a - b)·(c - d) stays what it is.
  void hold(const Place& a, const Place& b, const Place& c, const Place& d);

  /// `mass` at the middle of `a` and `b`, with its weight; and a second moment about the middle along their line, as
  /// that of a uniform rod, m/12 of their distance squared [kg].
  void add_rod(const Place& a, const Place& b, double mass, const Vec3& gravity);

  /// A second moment [kg m²] along a unit vector.
  void add_second_moment(const Place& unit, double moment);

  /// y = (q, q') at time 0, and y'.
  Vector start() const;
  Vector rate(const Vector& y) const;

  /// The nearest y with what is held: lengths in q, and their rates in q'.
  Vector projected(const Vector& y) const;

  Vec3 at(const Place& place, const Vector& y) const {
    return difference(place, fixed(Vec3::Zero()), y, false);
  }
  double energy(const Vector& y) const;

 private:
  struct Held {
    Place a, b, c, d;
    double value;
  };
  Vec3 difference(const Place& a, const Place& b, const Vector& y, bool velocity) const;
  Eigen::Index numbers() const { return static_cast<Eigen::Index>(start_.size()) * 3; }
  Vector gaps(const Vector& y) const;
  Eigen::MatrixXd jacobian(const Vector& y) const;
  void add_mass(const Place& a, const Place& b, double mass);

  std::vector<Vec3> start_, start_velocity_;
  std::vector<Held> held_;
  Eigen::MatrixXd M_;
  Vector weight_;
  double energy_of_fixed_ = 0;
};

}  // namespace spook
