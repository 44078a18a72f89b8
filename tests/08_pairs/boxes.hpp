#pragma once
// Pairs of boxes, and what is asked of their contacts.
#include <algorithm>
#include <string>
#include <vector>

#include "shapes.hpp"

namespace spook::testing {

inline std::vector<Contact> contacts_of(const Box& i, const Box& j) {
  std::vector<Contact> found;
  box_box(i, j, found);
  return found;
}

inline Box straight(int body, const Vec3& x, const Vec3& half_sides) {
  return {.body = body, .x = x, .axes = Mat3::Identity(), .half_sides = half_sides};
}

inline bool expect_count(const std::string& what, const std::vector<Contact>& got, int count,
                         const std::string& clue) {
  expect_near("contacts of " + what, "Eq. (8.8)", static_cast<double>(got.size()), count, {0, "a count"}, {},
              clue);
  return !::testing::Test::HasFailure();
}

/// Expects that each of `wanted`, points in the world, is the point of one contact with this gap and normal.
inline bool expect_points(const std::string& what, const Box& i, const Box& j, const std::vector<Contact>& got,
                          const std::vector<Vec3>& wanted, const Vec3& n, double gap, double size = 1) {
  for (const Vec3& p : wanted) {
    const auto nearest = std::min_element(got.begin(), got.end(), [&](const Contact& a, const Contact& b) {
      return (i.x + a.r_i - p).norm() < (i.x + b.r_i - p).norm();
    });
    const std::string which = what + ", the contact nearest to " + show(p);
    expect_true(which + ": i = " + std::to_string(nearest->i) + ", j = " + std::to_string(nearest->j),
                "Eq. (8.3)", nearest->i == i.body && nearest->j == j.body,
                "i is the body of the first box, " + std::to_string(i.body) + ", and j that of the second, " +
                    std::to_string(j.body) + ". Where the face is j's exchange them again at the end.");
    expect_near_vector(which + ": n", "Eq. (8.7)", nearest->n, n, {1e-9, "roundings"},
                       {{Vec3(-n), "n points from i to j: where the face is j's its outward normal is -n."}});
    expect_near(which + ": gap [m]", "Eq. (8.6), (8.8)", nearest->gap, gap, {1e-9, "roundings"},
                {{-gap, "This is a depth: the gap is negative where they overlap."},
                 {gap / 2, "Half the gap is for the point p. The gap itself is not halved."}},
                "The gap is the distance of the corner from the reference face.");
    const std::string surface = "p is half way between the two surfaces: this is on one of them.";
    const std::string sign =
        "p is half way between the two surfaces: from a corner of j go back by gap/2 along n, "
        "against the sign of the gap.";
    expect_near_vector(
        which + ": the point x_i + r_i [m]", "Eq. (8.3), (8.8)", Vec3(i.x + nearest->r_i), p,
        {4e-6 * size, "two of the clipping planes, moved outwards by a millionth of the smallest half side"},
        {{Vec3(p + gap / 2 * n), surface},
         {Vec3(p - gap / 2 * n), surface},
         {Vec3(p + gap * n), sign},
         {Vec3(p - gap * n), sign},
         {Vec3(i.x + p - j.x), "r_i is from the centre of i, r_j from that of j."}},
        "Overhanging corners are clipped by the four sides around the face that is met. Where edges cross, "
        "take "
        "their nearest points.");
    if (::testing::Test::HasFailure() || !expect_common_point(*nearest, i.x, j.x)) return false;
  }
  return true;
}

/// Tells whether a face of i or j has its normal within 8 degrees of n.
inline bool is_nearly_flat(const Box& i, const Box& j, const Vec3& n) {
  return std::max((i.axes.transpose() * n).cwiseAbs().maxCoeff(),
                  (j.axes.transpose() * n).cwiseAbs().maxCoeff()) >= 0.99;
}

}  // namespace spook::testing
