// Contacts within the margin: gaps, normals and points are those of the shapes themselves, however large the margin is.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/collision/contacts.hpp"
#include "engine/world/world.hpp"
#include "random_input.hpp"

namespace spook::contact_margin_test {
namespace {

constexpr double half = 0.1, open = 0.002;
constexpr double roundings = 1e-14;  // of lengths below 1 m

std::vector<Contact> found(const World<6>& world, double margin) {
  std::vector<Contact> contacts;
  ContactFinder().find(world.shapes(), world.bodies(), margin, contacts);
  return contacts;
}

Body<6> cube(const Vec3& x, const Quat& q = Quat::Identity()) {
  return {.x = x, .q = q, .half_sides = Vec3::Constant(half)};
}

Quat turned(double angle, const Vec3& axis) {
  return Quat(Eigen::AngleAxisd(angle, axis));
}

/// Two shapes whose surfaces are `open` apart along z.
struct OpenPair {
  std::string what;
  World<6> world;
};

std::vector<OpenPair> open_pairs() {
  const double diagonal = std::sqrt(2.0) * half, quarter = std::numbers::pi / 4;
  const Quat on_corner = Quat::FromTwoVectors(Vec3(1, 1, 1).normalized(), -Vec3::UnitZ());
  std::vector<OpenPair> pairs;
  const auto add = [&](const std::string& what, bool on_plane, const Body<6>& body,
                       const Quat& below = Quat::Identity(), double top = 0) {
    World<6> world({});
    if (on_plane)
      world.add_plane(Vec3::UnitZ(), 0);
    else
      world.add_fixed_box(Vec3(0, 0, -top), Vec3::Constant(half), below);
    world.add(body);
    pairs.push_back({what, world});
  };
  for (const bool plane : {true, false}) {
    const std::string on = plane ? " on a plane" : " on a box";
    add("a flat cube" + on, plane, cube(Vec3(0, 0, half + open)), Quat::Identity(), half);
    add("an edge" + on, plane, cube(Vec3(0, 0, diagonal + open), turned(quarter, Vec3::UnitY())),
        Quat::Identity(), half);
    add("a corner" + on, plane, cube(Vec3(0, 0, std::sqrt(3.0) * half + open), on_corner), Quat::Identity(),
        half);
    add("a ball" + on, plane, {.x = Vec3(0, 0, 0.05 + open), .radius = 0.05}, Quat::Identity(), half);
    add("a capsule" + on, plane,
        {.x = Vec3(0, 0, 0.05 + open),
         .radius = 0.05,
         .q = turned(std::numbers::pi / 2, Vec3::UnitY()),
         .half_length = 0.05},
        Quat::Identity(), half);
  }
  add("crossed edges", false, cube(Vec3(0, 0, diagonal + open), turned(quarter, Vec3::UnitX())),
      turned(quarter, Vec3::UnitY()), diagonal);
  add("a ball over an edge", false, {.x = Vec3(0, 0, 0.05 + open), .radius = 0.05},
      turned(quarter, Vec3::UnitY()), diagonal);
  return pairs;
}

TEST(ContactMargin, ChangesNoGapNormalOrPoint) {
  for (const auto& [what, world] : open_pairs())
    for (const double margin : {0.0021, 0.004, 0.01}) {
      const std::vector<Contact> contacts = found(world, margin);
      ASSERT_FALSE(contacts.empty()) << what << ", margin " << margin;
      for (const Contact& contact : contacts) {
        EXPECT_NEAR(contact.gap, open, roundings) << what << ", margin " << margin;
        EXPECT_NEAR(contact.n.z(), 1, roundings) << what << ", margin " << margin;
        const Vec3 from_i = world.x(contact.i) + contact.r_i, from_j = world.x(contact.j) + contact.r_j;
        EXPECT_LE((from_i - from_j).norm(), 1e-12) << what;
        const double height = from_i.z();
        EXPECT_GE(height, -roundings) << what;
        EXPECT_LE(height, open + roundings) << what << ": the point is between the surfaces";
        for (int axis = 0; axis < 2; ++axis) EXPECT_LE(std::abs(contact.r_j[axis]), half + roundings) << what;
      }
      EXPECT_TRUE(found(world, 0.0019).empty()) << what;
    }
}

// A box whose weight passes by its edge tips, with the default margin too: its arm is half a side.
TEST(ContactMargin, LeavesTheArmsOfABoxThatTips) {
  const double width = 0.05, height = 0.1;
  for (const bool on_plane : {true, false})
    for (const double share : {0.999, 1.001}) {
      const double slope = std::atan(share * width / height);
      World<6> world({.gravity = 9.81 * Vec3(std::sin(slope), 0, -std::cos(slope)), .friction = 2});
      if (on_plane)
        world.add_plane(Vec3::UnitZ(), 0);
      else
        world.add_fixed_box(Vec3(0, 0, -0.2), Vec3(2, 2, 0.2));
      const int box = world.add({.x = Vec3(0, 0, height), .half_sides = Vec3(width, 0.1, height)});
      while (world.time() < 5) world.step(1.0 / 60);
      const double tilt = 2 * std::acos(std::min(1.0, std::abs(orientation(world, box).w())));
      if (share < 1)
        EXPECT_LT(tilt, 1e-3) << "on a plane: " << on_plane;
      else
        EXPECT_GT(tilt, 1) << "on a plane: " << on_plane;
    }
}

// A search within a margin finds what a search without one finds where bodies overlap.
TEST(ContactMargin, ChangesNoOverlap) {
  testing::Random random;
  for (int n = 0; n < 300; ++n) {
    World<6> world({});
    const auto placed = [&] {
      const double x = random.uniform(-0.12, 0.12);
      const double y = random.uniform(-0.12, 0.12);
      const double z = random.uniform(-0.12, 0.12);
      return Vec3(x, y, z);
    };
    for (int body = 0; body < 2; ++body) {
      const Vec3 x = placed();
      const Quat q = random.rotation();
      world.add(cube(x, q));
    }
    const std::vector<Contact> overlap = found(world, 0), within = found(world, 1e-9);
    ASSERT_EQ(within.empty(), overlap.empty()) << "draw " << n << ", seed " << testing::Random::seed();
    if (overlap.empty()) continue;
    EXPECT_NEAR(within.front().gap, overlap.front().gap, 1e-8) << testing::Random::seed();
  }
}

}  // namespace
}  // namespace spook::contact_margin_test
