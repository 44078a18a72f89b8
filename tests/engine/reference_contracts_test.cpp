// Promises of the chapters' headers for inputs that the exercises' own tests do not have: NaN, and odd rows.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "08_pairs/pairs.hpp"
#include "14_fast_rows/fast_rows.hpp"

namespace spook::reference_contracts_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Box cube(int body, const Vec3& x) {
  return {.body = body, .x = x, .axes = Mat3::Identity(), .half_sides = Vec3::Ones()};
}

TEST(References, LetNoBoxTouchWhoseHalfSideIsNaN) {
  for (int axis = 0; axis < 3; ++axis) {
    Box bad = cube(0, Vec3::Zero()), good = cube(1, Vec3(0.1, 0.2, 1.9));
    bad.half_sides[axis] = nan;
    for (const bool first : {true, false}) {
      const SeparatingAxis found = first ? separating_axis(bad, good) : separating_axis(good, bad);
      EXPECT_EQ(found.gap, -infinity) << axis;
      EXPECT_EQ(found.face_i, -1) << axis;
      std::vector<Contact> contacts;
      first ? box_box(bad, good, contacts) : box_box(good, bad, contacts);
      EXPECT_TRUE(contacts.empty()) << axis;
    }
    EXPECT_FALSE(box_ball(bad, {.body = 1, .x = Vec3(0.1, 0.2, 0.3), .radius = 0.5})) << axis;
  }
}

TEST(References, PackRowsThatDoNotActOnBothBodies) {
  // The first row of a run acts on j only, and the second on both.
  const Motion<3> motion{.inverse_mass = {{.linear = 1}, {.linear = 1}},
                         .W = {Vec3(0, 1, 0), Vec3(1, 0, 0)},
                         .Wf = {Vec3::Zero(), Vec3::Zero()}};
  const auto row = [&](const Vec3& Gi, const Vec3& Gj) {
    return make_row<3>({.i = 0,
                        .j = 1,
                        .Gi = Gi,
                        .Gj = Gj,
                        .gap = 0,
                        .spook = {.a = 0, .b = 1, .Sigma = 0},
                        .lo = -infinity,
                        .hi = infinity},
                       motion);
  };
  std::vector<Row<3>> rows = {row(Vec3::Zero(), Vec3::UnitX()), row(-Vec3::UnitY(), Vec3::UnitY())},
                      swept = rows;
  std::vector<Twist<3>> V(2, Vec3::Zero()), wanted = V;
  const StopRule stop{.max_sweeps = 50, .tolerance = 1e-12};
  solve(swept, wanted, stop);
  std::vector<Colour<3>> colours = packed<3>(rows, 2);
  solve_in_colours<3>(colours, V, stop, 1);
  for (int body : {0, 1}) EXPECT_LE((V[body] - wanted[body]).norm(), 1e-12) << body;
}

}  // namespace
}  // namespace spook::reference_contracts_test
