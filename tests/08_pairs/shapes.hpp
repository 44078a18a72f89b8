#pragma once
// Random shapes that move, and what is asked of every contact, for the tests of this chapter.
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "08_pairs/pairs.hpp"
#include "exercise_test.hpp"

namespace spook::testing {

/// A box of body `body` at a random place, turned any way.
inline Box random_box(Random& random, int body, double place = 1) {
  const Vec3 x = random.vector(place);
  const Mat3 axes = random.rotation().toRotationMatrix();
  const Vec3 half_sides{random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1)};
  return {.body = body, .x = x, .axes = axes, .half_sides = half_sides};
}

/// Turned about an axis through its centre by an angle [rad].
inline Box turned(Box box, double angle, const Vec3& axis) {
  box.axes = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix() * box.axes;
  return box;
}

inline std::string describe(const Box& box) {
  return "a box at " + show(box.x) + " with half sides " + show(box.half_sides) + " and axes\n" +
         show(box.axes);
}

inline std::string describe_both(const Box& i, const Box& j) {
  return "given i, " + describe(i) + "\nand j, " + describe(j);
}

/// Returns the distance of a point from a box; 0 within.
inline double distance(const Box& box, const Vec3& p) {
  const Vec3 seen = box.axes.transpose() * (p - box.x);
  return (seen.cwiseAbs() - box.half_sides).cwiseMax(0).norm();
}

inline std::vector<Vec3> corners(const Box& box) {
  std::vector<Vec3> all;
  for (int k = 0; k < 8; ++k) {
    const Vec3 signs(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    all.push_back(box.x + box.axes * signs.cwiseProduct(box.half_sides));
  }
  return all;
}

/// Velocity of a body, and where it takes a shape in a short time t.
struct Drift {
  Vec3 v, omega;

  explicit Drift(Random& random) : v(random.vector()), omega(random.vector()) {}
  Drift() : v(Vec3::Zero()), omega(Vec3::Zero()) {}

  Twist<6> W() const {
    Twist<6> both;
    both << v, omega;
    return both;
  }
  Ball after(double t, Ball ball) const {
    ball.x += t * v;
    return ball;
  }
  Box after(double t, Box box) const {
    box.x += t * v;
    return omega.norm() > 0 ? turned(box, t * omega.norm(), omega) : box;
  }
};

/// Both arms end at one point, so that an impulse in any direction keeps the angular momentum of the two bodies.
inline bool expect_common_point(const Contact& contact, const Vec3& x_i, const Vec3& x_j) {
  const Vec3 between = x_j + contact.r_j - x_i - contact.r_i;
  expect_near_vector(
      "x_j + r_j less x_i + r_i, the ends of the two arms [m]", "Eq. (8.3)", between, Vec3::Zero(),
      roundings(64, 1 + x_i.norm() + x_j.norm() + contact.r_i.norm()),
      {{contact.gap * contact.n,
        "Each arm ends on its own body's surface. Friction J at two points, one overlap apart, adds the "
        "angular "
        "momentum overlap × J: let both end at one p."},
       {x_i + contact.r_j - x_j - contact.r_i, "r_i = p - x_i and r_j = p - x_j: the centres are exchanged."},
       {x_j - x_i, "r_i = r_j: an arm begins at the centre of its own body. Take off x_i, or x_j."}},
      "r_i = p - x_i, r_j = p - x_j, with the same p.");
  if (::testing::Test::HasFailure()) return false;
  const Vec3 J(0.3, -0.7, 0.5);
  const Vec3 added = x_j.cross(J) + contact.r_j.cross(J) - x_i.cross(J) - contact.r_i.cross(J);
  expect_near_vector("angular momentum that J = (0.3, -0.7, 0.5) N s adds to both bodies together", "Eq. (8.3)",
                     added, Vec3::Zero(), roundings(256, 1 + x_i.norm() + x_j.norm() + contact.r_i.norm()));
  return !::testing::Test::HasFailure();
}

/// Bodies, normal, gap and point of a contact.
struct Expected {
  int i, j;
  Vec3 n;
  double gap;
  Vec3 p;
  Vec3 x_i, x_j;
};

inline bool expect_contact(const std::string& what, const std::string& equations, const Contact& got,
                           const Expected& want, std::initializer_list<Clue<double>> gap_clues,
                           std::initializer_list<Clue<Vec3>> point_clues) {
  const double size = 1 + want.x_i.norm() + want.x_j.norm() + want.p.norm();
  expect_true(what + ": i = " + std::to_string(got.i) + ", j = " + std::to_string(got.j), equations,
              got.i == want.i && got.j == want.j,
              "i is to be " + std::to_string(want.i) + " and j " + std::to_string(want.j) + ".");
  expect_near(what + ": gap [m]", equations, got.gap, want.gap, roundings(64, size), gap_clues);
  expect_near_vector(what + ": n", equations, got.n, want.n, roundings(64, size),
                     {{Vec3(-want.n), "n points from i to j: this is from j to i."}},
                     "A unit vector from i to j.");
  if (::testing::Test::HasFailure()) return false;
  expect_near_vector(what + ": the point x_i + r_i [m]", equations, Vec3(want.x_i + got.r_i), want.p,
                     roundings(64, size), point_clues);
  if (::testing::Test::HasFailure()) return false;
  return expect_common_point(got, want.x_i, want.x_j);
}

/// G W of a contact is the rate of `gap_after(t)`, a number of the two bodies where they have moved to.
inline void expect_rate(const Contact& contact, const Drift& i, const Drift& j,
                        const std::function<double(double)>& gap_after) {
  const double dt = 1e-5;
  const double rate = (gap_after(dt) - gap_after(-dt)) / (2 * dt);
  const ContactJacobian G = contact_jacobian(contact);
  expect_near(
      "G W against the gap of moving bodies, differentiated numerically [m/s]", "Eq. (8.15)",
      G.Gi.dot(i.W()) + G.Gj.dot(j.W()), rate,
      {1e-6, "dt² times the third derivative of the gap, below 1e4 m/s³, and roundings of 10 m over dt"},
      {{-rate, "The sign: n points from i to j."}},
      "Check n, r_i and r_j. If they are right, the rotation of n does not change the rate of the gap, Eq. "
      "(8.15).");
}

}  // namespace spook::testing
