#pragma once
// Point masses on links and rigid bodies on joints, stepped in time, for the tests of chapter 06.
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "06_distance/distance.hpp"
#include "checks.hpp"
#include "random_input.hpp"

namespace spook::testing {

/// The larger of two numbers, as std::max, except that a NaN stays a NaN.
inline double larger(double a, double b) {
  return std::isnan(a) || a > b ? a : b;
}

/// The result of a solve.
template <int Dof>
struct Solution {
  std::vector<double> lambda;  ///< impulse of each constraint [N s]
  std::vector<Twist<Dof>> V;   ///< velocity change of each body
};

/// Returns the rows of the constraints. Reports a row that would make the solver stop the program.
template <int Dof>
std::vector<Row<Dof>> rows_of(const std::vector<Constraint<Dof>>& constraints, const Motion<Dof>& motion) {
  const int bodies = static_cast<int>(motion.W.size());
  std::vector<Row<Dof>> rows;
  for (const Constraint<Dof>& c : constraints) {
    if (!(c.lo <= c.hi)) throw std::logic_error("a row has the bounds " + show(c.lo) + " and " + show(c.hi));
    if (!(0 <= c.i && c.i < bodies && 0 <= c.j && c.j < bodies && c.i != c.j))
      throw std::logic_error("a row has i = " + std::to_string(c.i) + " and j = " + std::to_string(c.j) +
                             ", with " + std::to_string(bodies) + " bodies");
    rows.push_back(make_row(c, motion));
  }
  return rows;
}

/// λ from zero.
template <int Dof>
Solution<Dof> solved(const std::vector<Constraint<Dof>>& constraints, const Motion<Dof>& motion,
                     const StopRule& stop) {
  std::vector<Row<Dof>> rows = rows_of(constraints, motion);
  Solution<Dof> solution;
  solution.V.assign(motion.W.size(), Twist<Dof>::Zero());
  solve(rows, solution.V, stop);
  for (const Row<Dof>& row : rows) solution.lambda.push_back(row.lambda);
  return solution;
}

/// Reports a simulation that a wrong answer has made grow without bounds.
inline void require_within_reach(const Vec3& x) {
  if (!(x.norm() < 1e6))
    throw std::logic_error("a body is 1000 km away, or nowhere: the simulation has blown up");
}

constexpr double gravity = 10;  // [m/s²], along -z

/// Point masses; v is half a step behind x.
struct Points {
  double g = gravity;
  double drag = 0;  ///< of the air: the force is -drag m v [1/s]
  std::vector<Vec3> x = {}, v = {};
  std::vector<double> inverse_mass = {};  ///< body 0 is static

  void add(const Vec3& at, double inverse) {
    x.push_back(at);
    v.push_back(Vec3::Zero());
    inverse_mass.push_back(inverse);
  }

  Attachment at(int body) const {
    if (!(0 <= body && body < static_cast<int>(x.size())))
      throw std::logic_error("a link ends at point " + std::to_string(body) + "; there are only " +
                             std::to_string(x.size()));
    return {.body = body, .x = x[static_cast<std::size_t>(body)]};
  }

  double fastest() const {
    double speed = 0;
    for (const Vec3& velocity : v) speed = larger(speed, velocity.norm());
    return speed;
  }

  Motion<3> motion(double h) const {
    Motion<3> motion;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const bool held = inverse_mass[k] == 0;
      motion.inverse_mass.push_back({.linear = inverse_mass[k]});
      motion.W.push_back(v[k]);
      motion.Wf.push_back(held ? Vec3::Zero() : Vec3(-h * g * Vec3::UnitZ() - h * drag * v[k]));
    }
    return motion;
  }

  /// Advances by one step with these constraints. Returns the λ [N s].
  std::vector<double> step(const std::vector<Constraint<3>>& constraints, double h, const StopRule& stop) {
    const Motion<3> before = motion(h);
    const Solution<3> solution = solved(constraints, before, stop);
    for (std::size_t k = 0; k < x.size(); ++k) {
      v[k] += before.Wf[k] + solution.V[k];  // Eq. (3.12)
      x[k] = drift(x[k], v[k], h);
      require_within_reach(x[k]);
    }
    return solution.lambda;
  }
};

/// A rigid body; v and ω are half a step behind x and q.
struct Rigid {
  double inverse_mass;  ///< body 0 is static
  Vec3 principal;       ///< moments [kg m²]
  Vec3 x;
  Quat q = Quat::Identity();
  Vec3 v = Vec3::Zero(), omega = Vec3::Zero();

  Vec3 momentum() const { return v / inverse_mass; }
  /// About the origin.
  Vec3 angular_momentum() const { return x.cross(momentum()) + world_inertia(q, principal) * omega; }
};

/// Returns a solid box of 0.5 to 2 kg with edges of 0.4 to 1.2 m, in any orientation.
inline Rigid random_box(Random& random) {
  const double mass = random.uniform(0.5, 2);
  const Vec3 edges{random.uniform(0.4, 1.2), random.uniform(0.4, 1.2), random.uniform(0.4, 1.2)};
  const Vec3 squares = edges.cwiseProduct(edges);
  const Vec3 principal = mass / 12 * (Vec3::Constant(squares.sum()) - squares);
  return {.inverse_mass = 1 / mass, .principal = principal, .x = random.vector(2), .q = random.rotation()};
}

/// Advances rigid bodies by one step with these constraints, with gravity or without. Returns the λ [N s].
inline std::vector<double> step(std::vector<Rigid>& bodies, const std::vector<Constraint<6>>& constraints,
                                bool weight, double h, const StopRule& stop) {
  Motion<6> motion;
  for (const Rigid& body : bodies) {
    const bool held = body.inverse_mass == 0;
    motion.inverse_mass.push_back(
        {.linear = body.inverse_mass,
         .angular = held ? Mat3::Zero() : world_inertia(body.q, body.principal.cwiseInverse())});
    motion.W.push_back((Twist<6>() << body.v, body.omega).finished());
    motion.Wf.push_back((weight && !held ? -h * gravity : 0.0) * Twist<6>::Unit(2));
  }
  const Solution<6> solution = solved(constraints, motion, stop);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    Rigid& body = bodies[k];
    const Twist<6> change = motion.Wf[k] + solution.V[k];  // Eq. (3.12)
    body.v += change.head<3>();
    body.omega += change.tail<3>();
    body.x = drift(body.x, body.v, h);
    require_within_reach(body.x);
    if (body.inverse_mass > 0) free_rotation(body.q, body.omega, body.principal, h);
  }
  return solution.lambda;
}

}  // namespace spook::testing
