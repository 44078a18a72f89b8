#pragma once
// Two points of two bodies, and checks for every row between them.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "06_distance/distance.hpp"
#include "checks.hpp"
#include "random_input.hpp"
#include "regions.hpp"

namespace spook::testing {

/// Points of two rigid bodies that lie 1 to 2 m from each other. Body indices that a row has to copy.
struct RandomPair {
  Random random;
  Attachment i{.body = 4, .x = random.vector(), .r = random.vector()};
  Attachment j{.body = 2, .x = Vec3::Zero(), .r = random.vector()};
  Vec3 n = random.unit_vector();  ///< from i's point to j's point
  double distance = random.uniform(1, 2);
  double length = random.uniform(0.5, 2.5);
  SpookParameters spook{
      .a = random.uniform(1, 10), .b = random.uniform(0.5, 1), .Sigma = random.uniform(0.05, 0.2)};

  explicit RandomPair(const Random& stream = Random()) : random(stream) { put(); }

  /// Moves j so that the points have this distance.
  void put() {
    j.x = i.x + i.r + distance * n - j.r;
    given() = "given x_i = " + show(i.x) + ", r_i = " + show(i.r) + ", x_j = " + show(j.x) +
              ", r_j = " + show(j.r) + " m";
  }

  Vec3 apart() const { return distance * n; }
  /// The size of the numbers that are added up in the gap [m].
  double size() const { return i.x.norm() + i.r.norm() + j.x.norm() + j.r.norm() + length; }
};

/// Returns the next random pair, of any kind: bodies in either order, arms of any length or 0, points near or far, and
/// too far apart or too close.
inline RandomPair any_pair(const Random& stream) {
  RandomPair t(stream);
  Random& random = t.random;
  t.i.body = random.integer(0, 9);
  t.j.body = (t.i.body + random.integer(1, 9)) % 10;
  for (Vec3* r : {&t.i.r, &t.j.r}) *r *= random.integer(0, 2) == 0 ? 0 : random.log_uniform(0.1, 10);
  t.distance = random.log_uniform(0.1, 10);
  t.length = random.log_uniform(0.1, 10) * t.distance;
  t.put();
  return t;
}

/// The kinds of pairs, and whether this pair is of each kind.
inline std::vector<std::pair<std::string, bool>> kinds_of(const RandomPair& t) {
  const bool at_i = t.i.r.norm() == 0, at_j = t.j.r.norm() == 0;
  const double arms = std::max(t.i.r.norm(), t.j.r.norm());
  return {{"i before j", t.i.body < t.j.body},
          {"j before i", t.j.body < t.i.body},
          {"i's point is its centre, j's is not", at_i && !at_j},
          {"j's point is its centre, i's is not", at_j && !at_i},
          {"both points are their bodies' centres", at_i && at_j},
          {"arms shorter than the distance", !at_i && !at_j && arms < t.distance},
          {"arms longer than the distance", arms > t.distance}};
}

/// Eq. (6.1) a time t later, when the body moves and turns with W.
inline Vec3 point_after(double t, const Attachment& at, const Twist<6>& W) {
  const Vec3 v = W.head<3>(), omega = W.tail<3>();
  return at.x + t * v + Eigen::AngleAxisd(t * omega.norm(), omega.normalized()) * at.r;
}

/// The attachment then.
inline Attachment attachment_after(double t, Attachment at, const Twist<6>& W) {
  const Vec3 p = point_after(t, at, W);
  at.x += t * W.head<3>();
  at.r = p - at.x;
  return at;
}

/// Angular momentum about the origin that an impulse of 1 N s along the row adds [m].
inline Vec3 angular_momentum_of(const Constraint<6>& row, const Attachment& i, const Attachment& j) {
  return i.x.cross(row.Gi.head<3>()) + row.Gi.tail<3>() + j.x.cross(row.Gj.head<3>()) + row.Gj.tail<3>();
}

template <int Dof>
void expect_pulls_and_pushes(const std::string& row, const Constraint<Dof>& c) {
  const std::string text = c.lo == 0   ? "These are a contact's bounds: it may only push. This row pulls, too."
                           : c.hi == 0 ? "These bounds allow only a pull. A distance also pushes."
                           : c.lo > c.hi ? "The bounds are exchanged: no λ lies between them."
                                         : "Neither direction of λ has a bound.";
  expect_true(row + " has the bounds lo = -∞ and hi = ∞; here lo = " + show(c.lo) + ", hi = " + show(c.hi),
              "Eq. (6.4)", c.lo == -infinity && c.hi == infinity, text);
}

template <int Dof>
void expect_carries(const std::string& row, const Constraint<Dof>& c, const RandomPair& pair) {
  expect_true(row + " is between body " + std::to_string(pair.i.body) + " as i and body " +
                  std::to_string(pair.j.body) + " as j; here i = " + std::to_string(c.i) +
                  ", j = " + std::to_string(c.j),
              "Eq. (6.3)", c.i == pair.i.body && c.j == pair.j.body,
              "Copy the bodies of the two attachments, in that order.");
  const std::string set = "Copy the argument `spook`.";
  expect_near("a of " + row + " [1/s]", "Eq. (3.4)", c.spook.a, pair.spook.a, {0, "a copy"}, {}, set);
  expect_near("b of " + row, "Eq. (3.5)", c.spook.b, pair.spook.b, {0, "a copy"}, {}, set);
  expect_near("Σ of " + row + " [1/kg]", "Eq. (3.6)", c.spook.Sigma, pair.spook.Sigma, {0, "a copy"}, {}, set);
}

}  // namespace spook::testing
