// Boxes with planes, balls and each other: every contact is found, for any number of bodies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/bodies/conserved_quantities.hpp"
#include "engine/world/world.hpp"
#include "random_input.hpp"
#include "refusals.hpp"

namespace spook::box_shapes_test {
namespace {

constexpr double h = 1.0 / 60, g = 9.81, k = 1e6;

Body<6> box(const Vec3& x, const Vec3& half_sides, double mass = 1) {
  return {.x = x, .mass = mass, .principal = solid_box_moments(mass, half_sides), .half_sides = half_sides};
}

TEST(Boxes, ThatAreNaNTouchNothing) {
  const Box i{.body = 0, .x = Vec3::Zero(), .axes = Mat3::Identity(), .half_sides = Vec3::Constant(0.5)};
  Box j = i;
  j.body = 1;
  j.x.setConstant(std::nan(""));
  std::vector<Contact> contacts;
  box_box(i, j, contacts);
  EXPECT_TRUE(contacts.empty());
}

TEST(Boxes, AreRefusedWithAnotherShapeOrNoSize) {
  World<6> world({});
  Body<6> body = box(Vec3::Zero(), Vec3(1, 1, 1));
  body.radius = 1;
  expect_refusal({"radius", "half_sides"}, [&] { world.add(body); });
  body.radius = 0;
  body.corners = {Vec3(1, 0, 0)};
  expect_refusal({"corners", "half_sides"}, [&] { world.add(body); });
  body.corners = {};
  body.half_sides = Vec3(1, -1, 1);
  expect_refusal({"half side", "-1"}, [&] { world.add(body); });
  body.half_sides = Vec3(1, 0, 1);
  expect_refusal({"half side", "0"}, [&] { world.add(body); });
}

TEST(Boxes, RestOnEachOtherAndOnTheGround) {
  // Four contacts a level: gap = -N/(4 k), Eq. (3.13).
  World<6> world({.k = k, .friction = 0.5, .solver = find_solver<6>("direct").make_on_box()});
  world.add_plane(Vec3::UnitZ(), 0);
  const Vec3 half(0.5, 0.3, 0.2);
  // They overlap a little, so that round-off does not decide which corners touch first.
  const int low = world.add(box(Vec3(0, 0, half.z() - 1e-7), half, 2));
  const int top = world.add(box(Vec3(0, 0, 3 * half.z() - 2e-7), half, 1));
  for (int step = 0; step < 200; ++step) world.step(h);
  EXPECT_EQ(world.contacts().size(), 8U);
  const double sunk_low = 3 * g / (4 * k), sunk_top = sunk_low + g / (4 * k);
  EXPECT_NEAR(world.x(low).z(), half.z() - sunk_low, 1e-10);
  EXPECT_NEAR(world.x(top).z(), 3 * half.z() - sunk_top, 1e-10);
  EXPECT_LE(world.x(top).head<2>().norm(), 1e-10);
}

TEST(Boxes, CarryABall) {
  World<6> world({.k = k, .solver_limits = {.max_sweeps = 2000, .tolerance = 1e-12}});
  world.add_plane(Vec3::UnitZ(), 0);
  const Vec3 half(0.5, 0.5, 0.5);
  world.add(box(Vec3(0, 0, 0.5), half));
  const int ball = world.add({.x = Vec3(0, 0, 1.2), .radius = 0.2, .principal = solid_sphere_moments(1, 0.2)});
  for (int step = 0; step < 200; ++step) world.step(h);
  EXPECT_EQ(world.contacts().size(), 5U);
  EXPECT_NEAR(world.x(ball).z(), 1.2 - 2 * g / (4 * k) - g / k, 1e-10);
}

TEST(Boxes, ThatMeetInTheVoidKeepTheirMomenta) {
  World<6> world({.gravity = Vec3::Zero(), .k = 1e3, .friction = 0.3});
  const Vec3 half(0.5, 0.3, 0.2);
  Body<6> a = box(Vec3::Zero(), half), b = box(Vec3(0.9, 0.1, 0.05), half, 3);
  a.omega = Vec3(1, 2, -1);
  b.v = Vec3(-1, 0.2, 0);
  b.q = Quat(0.9, 0.1, -0.3, 0.2).normalized();
  world.add(a);
  world.add(b);
  const Vec3 p = momentum(world.bodies()), L = angular_momentum(world.bodies());
  std::size_t contacts = 0;
  for (int step = 0; step < 60; ++step) {
    world.step(h);
    contacts += world.contacts().size();
  }
  EXPECT_GT(contacts, 0U) << "they should meet";
  EXPECT_LE((momentum(world.bodies()) - p).norm(), 1e-13);
  EXPECT_LE((angular_momentum(world.bodies()) - L).norm(), 1e-13);
}

/// The pairs of bodies that touch, in any order.
std::set<std::pair<int, int>> touching(const World<6>& world) {
  std::set<std::pair<int, int>> pairs;
  for (const Contact& contact : world.contacts()) pairs.insert(std::minmax(contact.i, contact.j));
  return pairs;
}

TEST(Contacts, AreAllFoundHoweverManyBodiesThereAre) {
  // Below and above the number at which the broad phase changes: 32 and 2000 bodies.
  testing::Random random;
  for (const int n : {20, 32, 33, 300, 2000, 2001}) {
    World<6> world({.gravity = Vec3::Zero(), .k = 1e-6});
    const double side = std::cbrt(n);
    std::vector<Ball> balls;
    for (int i = 0; i < n; ++i) {
      const Ball ball{.body = i, .x = side * random.vector(0, 1), .radius = random.uniform(0.05, 0.6)};
      balls.push_back(ball);
      world.add({.x = ball.x, .radius = ball.radius, .principal = Vec3::Ones()});
    }
    world.step(1e-6);
    std::set<std::pair<int, int>> expected;
    for (const Ball& a : balls)
      for (const Ball& b : balls)
        if (a.body < b.body && (a.x - b.x).norm() <= a.radius + b.radius) expected.insert({a.body, b.body});
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(touching(world), expected) << n << " balls";
    if (n > 32) {
      EXPECT_LT(world.report().pairs, n * (n - 1) / 4) << "most pairs need no narrow phase";
    }
  }
}

}  // namespace
}  // namespace spook::box_shapes_test
