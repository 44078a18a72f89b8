#pragma once
// Mechanisms in natural coordinates: points and unit vectors, which neighbouring bodies share. Unlike the engine, this
// method has no orientations, angular velocities or joints.
//
//   q            positions of points [m], and unit vectors fixed to bodies, three numbers each
//   T            ½ q'ᵀ M q', M constant: a body is a mass m at its centre and a second moment along each of its axes
//   constraint   (a - b)·(c - d) = constant, for points or vectors a, b, c, d: lengths, right angles, unit lengths
//
//   M q'' + Gᵀ μ = Q,   G q'' = -2 (a' - b')·(c' - d')                  index 1; constraints may be redundant
//
// Two bodies that share a point have a ball joint; two bodies that also share a vector have a hinge.
//
// Source: J. García de Jalón and E. Bayo, Kinematic and Dynamic Simulation of Multibody Systems, Springer 1994.
#include <vector>

#include <Eigen/Dense>

#include "common/types.hpp"

namespace spook {

class NaturalCoordinates {
 public:
  using Vector = Eigen::VectorXd;

  /// A point or a vector: the number of a moving one, or the coordinates of a fixed one.
  struct Place {
    int moving = -1;
    Vec3 fixed = Vec3::Zero();
  };

  /// Adds a moving point or vector, with its position and velocity at time 0.
  Place add(const Vec3& x, const Vec3& v = Vec3::Zero());
  static Place fixed(const Vec3& x) { return {.fixed = x}; }

  /// Adds the constraint that (a - b)·(c - d) keeps its current value.
  void hold(const Place& a, const Place& b, const Place& c, const Place& d);

  /// Adds a uniform rod from `a` to `b`: its `mass` [kg], with its weight, at the middle, and a second moment of
  /// mass/12 times its length squared along its line.
  void add_rod(const Place& a, const Place& b, double mass, const Vec3& gravity);

  /// Adds a second moment [kg m²] along a unit vector.
  void add_second_moment(const Place& unit, double moment);

  /// Returns y = (q, q') at time 0, and the rate y'.
  Vector start() const;
  Vector rate(const Vector& y) const;

  /// Returns the nearest y that satisfies the constraints in q, and their rates in q'.
  Vector projected(const Vector& y) const;

  Vec3 at(const Place& place, const Vector& y) const {
    return difference(place, fixed(Vec3::Zero()), y, false);
  }
  double energy(const Vector& y) const;

 private:
  struct Constraint {
    Place a, b, c, d;
    double value;
  };
  Vec3 difference(const Place& a, const Place& b, const Vector& y, bool velocity) const;
  Eigen::Index numbers() const { return static_cast<Eigen::Index>(start_.size()) * 3; }
  Vector gaps(const Vector& y) const;
  Eigen::MatrixXd jacobian(const Vector& y) const;
  void add_mass(const Place& a, const Place& b, double mass);

  std::vector<Vec3> start_, start_velocity_;
  std::vector<Constraint> constraints_;
  Eigen::MatrixXd M_;
  Vector weight_;
  double energy_of_fixed_ = 0;
};

}  // namespace spook
