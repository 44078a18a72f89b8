// Two boxes: enough contacts to hold any load that the common area can hold, Eq. (8.10).
#include <algorithm>
#include <numbers>
#include <utility>

#include "boxes.hpp"
#include "regions.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(BoxBox, "8.8 box_box");

EXERCISE_TEST(BoxBox, KeepsEveryCornerThatIsDeep) {
  // The lower face of j, turned by 45 degrees and cut by the sides of i, is an octagon.
  const Box below = straight(0, Vec3::Zero(), Vec3(0.5, 0.5, 0.5));
  Box above = turned(straight(1, Vec3(0, 0, 0.999), Vec3(0.5, 0.5, 0.5)), std::numbers::pi / 4, Vec3::UnitZ());
  const std::string what = "a cube on an equal one, turned by 45 degrees";
  given() = describe_both(below, above);
  const auto got = contacts_of(below, above);
  expect_near(
      "contacts of " + what, "Eq. (8.8), (8.10)", static_cast<double>(got.size()), 8, {0, "a count"},
      {{4,
        "Four of eight hold less load than all: where its line of action is over a corner that was left "
        "out, the cube tips. Keep all corners with g <= 0."}},
      "The octagon has eight corners, and all are as deep.");
  if (::testing::Test::HasFailure()) return;
  std::vector<Vec3> wanted;
  for (int k = 0; k < 8; ++k) {
    const double angle = std::numbers::pi * (k + 0.5) / 4, reach = 0.5 / std::cos(std::numbers::pi / 8);
    wanted.emplace_back(reach * std::cos(angle), reach * std::sin(angle), 0.4995);
  }
  expect_points(what, below, above, got, wanted, Vec3::UnitZ(), -1e-3);
}

EXERCISE_TEST(BoxBox, LeavesOutCornersThatHardlyChangeTheHull) {
  // Turned by little, each side of the square gets a corner near its middle; at 45 degrees no corner is flat.
  const Box below = straight(0, Vec3::Zero(), Vec3(0.5, 0.5, 0.5));
  for (const double angle : {1e-4, 1e-3, 0.03, 0.2, 0.5}) {
    Box above = turned(straight(1, Vec3(0, 0, 0.999), Vec3(0.5, 0.5, 0.5)), angle, Vec3::UnitZ());
    given() = describe_both(below, above);
    // Two corners of the octagon are s apart: a corner is s/√2 from the line of its neighbours, to first order.
    const int count = angle < 0.1 ? 4 : 8;
    expect_near(
        "contacts of a cube on an equal one, turned by " + show(angle), "Eq. (8.10)",
        static_cast<double>(contacts_of(below, above).size()), count, {0, "a count"},
        {{8,
          "Two contacts near each other are twice as stiff as one, but hold no more load. While more than "
          "four are left, leave out corners that are close to the line through their neighbours."}},
        "A corner is left out if it is closer to this line than 0.02 of the smallest half side.");
    if (::testing::Test::HasFailure()) return;
  }
  // Sides that nearly lie on each other cross: a fifth corner in the middle of a side, which comes and goes.
  Box above = turned(straight(1, Vec3(1e-5, 0, 0.999), Vec3(0.5, 0.5, 0.5)), 1e-4, Vec3::UnitZ());
  given() = describe_both(below, above);
  expect_count("a cube on an equal one, shifted and turned by little", contacts_of(below, above), 4,
               "Four corners have nearly the hull of all.");
}

/// A plate that slopes down over the rim x = 1/2 of a cube, and leans by little to one side. Of all axes that of the rim
/// and of its lower edge has the largest gap, -depth.
std::pair<Box, Box> plate_over_the_rim(double depth) {
  const Box cube = straight(2, Vec3::Zero(), Vec3::Constant(0.5));
  Box plate = straight(7, Vec3::Zero(), Vec3(1, 0.3, 0.25));
  plate = turned(turned(plate, 0.004, Vec3::UnitX()), 0.05, Vec3::UnitY());
  // From the lower edge, at y = -0.3, to its end that is farther down.
  const Vec3 lower = plate.axes * Vec3(1, -0.3, -0.25), along = plate.axes.col(0);
  // The edge crosses the rim where x is 1/2, and there it is `depth` lower, along the axis.
  const Vec3 n = Vec3::UnitY().cross(along).normalized() * (along.x() > 0 ? -1 : 1);
  const Vec3 crossing = lower - lower.x() / along.x() * along + 0.5 / along.x() * along;
  plate.x = Vec3(0, 0, 0.5 - crossing.z() - depth / std::abs(n.z()));
  return {cube, plate};
}

EXERCISE_TEST(BoxBox, TakesAFaceThatIsNearlyFlat) {
  // At 4 mm the other edge, 2.4 mm higher, is over the rim, too; at 1 mm it is above the cube.
  for (const double depth : {0.004, 0.001}) {
    const auto [cube, plate] = plate_over_the_rim(depth);
    given() = describe_both(cube, plate);
    const auto got = contacts_of(cube, plate);
    const std::string what =
        "a plate that slopes over the rim of a cube by 3 degrees, " + show(1e3 * depth) + " mm deep";
    if (depth < 0.002) {
      if (!expect_count(what, got, 1, "A single corner is no better than the edges' own contact.")) return;
      expect_at_most("|n_x|, with n across the rim and the plate's edge, of " + what, "Eq. (8.9)",
                     std::abs(std::abs(got[0].n.x()) - std::sin(0.05)), 1e-4,
                     "the sine of the slope, the small lean aside",
                     "If the face has one contact only, the contact is that of the edges, with their n.");
      continue;
    }
    expect_near(
        "contacts of " + what, "Eq. (8.9), (8.10)", static_cast<double>(got.size()), 2, {0, "a count"},
        {{1,
          "One contact at the crossing of two edges cannot keep the plate from tipping, and its other edge "
          "is below the cube's top, too. n is nearly that of the face: take the contacts on the face."}},
        "Both lower edges of the plate are below the cube's top where they cross its rim.");
    if (::testing::Test::HasFailure()) return;
    for (const double y : {-0.3, 0.3}) {
      const Vec3 low = plate.x + plate.axes * Vec3(1, y, -0.25), along = plate.axes.col(0);
      const Vec3 corner = low + (0.5 + 1e-6 * 0.25 - low.x()) / along.x() * along;
      const double gap = corner.z() - 0.5;
      if (!expect_points(what, cube, plate, got, {corner - gap / 2 * Vec3::UnitZ()}, Vec3::UnitZ(), gap))
        return;
    }
  }
}

/// Returns the points of the contacts on the face of `box` along its axis k, with outward normal n, with `other`.
std::vector<Vec3> points_on_face(const Box& box, int k, const Vec3& n, const Box& other) {
  int along;
  const Vec3 seen = other.axes.transpose() * n;
  seen.cwiseAbs().maxCoeff(&along);
  std::vector<Vec3> polygon;
  for (const auto& [u, v] : {std::pair(1, 1), {1, -1}, {-1, -1}, {-1, 1}}) {
    Vec3 signs;
    signs[along] = seen[along] > 0 ? -1 : 1, signs[(along + 1) % 3] = u, signs[(along + 2) % 3] = v;
    polygon.push_back(other.x + other.axes * signs.cwiseProduct(other.half_sides));
  }
  const double slack = 1e-6 * box.half_sides.cwiseMin(other.half_sides).minCoeff();
  for (int side = 0; side < 3; ++side)
    for (const double sign : {1.0, -1.0}) {
      const Vec3 e = sign * box.axes.col(side);
      if (side != k) polygon = clip(polygon, e, e.dot(box.x) + box.half_sides[side] + slack);
    }
  const auto gap = [&](const Vec3& p) { return n.dot(p - box.x) - box.half_sides[k]; };
  std::erase_if(polygon, [&](const Vec3& p) { return gap(p) > 0; });
  for (Vec3& p : polygon) p -= gap(p) / 2 * n;
  return polygon;
}

EXERCISE_TEST(BoxBox, TakesANearlyFlatFaceOfEitherBox) {
  // Boxes that are nearly square on each other, either of them above, and with the axes of j in any order.
  Random random;
  Regions regions(
      {"a face of i", "a face of j", "against the axis of i", "against the axis of j", "one contact only"}, 30);
  while (regions.lack_draws()) {
    const Box i = random_box(random, 0);
    Box j = random_box(random, 1, 2);
    for (int k = 0; k < 3; ++k) j.axes.col(k) = i.axes.col((k + 1) % 3);
    const double around = random.uniform(0, 6);
    const int upright = random.integer(0, 2);
    const double tilt = random.uniform(0, 0.26);
    const Vec3 tilted_about = random.unit_vector();
    j = turned(turned(j, around, i.axes.col(upright)), tilt, tilted_about);
    const Vec3 line = (j.x - i.x).normalized();
    double deep = 0, apart = 5;
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = (deep + apart) / 2;
      j.x = i.x + middle * line;
      (separating_axis(i, j).gap < -5e-3 ? deep : apart) = middle;
    }
    j.x = i.x + deep * line;
    const SeparatingAxis axis = separating_axis(i, j);
    int k = 0, l = 0;
    const Vec3 along_i = i.axes.transpose() * axis.n, along_j = j.axes.transpose() * axis.n;
    const double cosine_i = along_i.cwiseAbs().maxCoeff(&k), cosine_j = along_j.cwiseAbs().maxCoeff(&l);
    const bool on_i = cosine_i >= 0.99, on_j = !on_i && cosine_j >= 0.99,
               against = (on_i ? along_i[k] : along_j[l]) < 0;
    if (axis.edge_i < 0 || !(on_i || on_j)) {
      regions.draw({});
      continue;
    }
    const Vec3 n = (against ? -1 : 1) * (on_i ? Vec3(i.axes.col(k)) : Vec3(j.axes.col(l)));
    const std::vector<Vec3> points = on_i ? points_on_face(i, k, n, j) : points_on_face(j, l, -n, i);
    if (points.size() > 4) {  // which of them are left out depends on where one starts
      regions.draw({});
      continue;
    }
    const bool flat = points.size() >= 2;
    regions.draw({{"a face of i", on_i && flat},
                  {"a face of j", on_j && flat},
                  {"against the axis of i", on_i && flat && against},
                  {"against the axis of j", on_j && flat && against},
                  {"one contact only", !flat}});
    given() = describe_both(i, j);
    const auto got = contacts_of(i, j);
    const std::string what =
        std::string("two edges, where a face of ") + (on_i ? "i" : "j") + " is nearly flat";
    if (!expect_count(
            what, got, flat ? static_cast<int>(points.size()) : 1,
            "Look at the faces of i, then at those of j, whichever way their axes point. If the face has two "
            "contacts or more, take them; else that of the edges."))
      return;
    if (!flat) continue;
    for (const Vec3& p : points) {
      double least = infinity;
      for (const Contact& contact : got) least = std::min(least, (i.x + contact.r_i - p).norm());
      expect_at_most("distance of " + show(p) + " from a contact, of " + what + " [m]", "Eq. (8.8)", least,
                     1e-9, "roundings", "Use the face as if the axis were its normal, from i to j.");
    }
    for (const Contact& contact : got)
      expect_near_vector("n of a contact, of " + what, "Eq. (8.7)", contact.n, n, roundings(16),
                         {{Vec3(-n), "n points from i to j: where the face is j's its outward normal is -n."}});
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
