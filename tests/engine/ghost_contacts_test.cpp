// Flush boxes make one surface: a sliding body keeps its speed, and a higher box is still a wall.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/collision/ghost_contacts.hpp"
#include "engine/world/world.hpp"
#include "random_input.hpp"

namespace spook::ghost_contacts_test {
namespace {

constexpr double g = 9.81, speed = 4, half = 0.2;
constexpr double steps_per_second[] = {30, 60, 120, 240, 1000};

enum class Slider { cube, ball, capsule };

/// Adds a body that lies at a height of 0, with a depth of its sag.
int add_slider(World<6>& world, Slider kind, double mass, const Vec3& heading, double sag) {
  Body<6> body{.x = Vec3(0, 0, half - sag), .v = speed * heading, .mass = mass};
  if (kind == Slider::cube) body.half_sides = Vec3::Constant(half);
  if (kind != Slider::cube) body.radius = half;
  if (kind == Slider::capsule) {
    body.half_length = half;
    body.q = Quat(Eigen::AngleAxisd(std::acos(-1) / 2, Vec3(0.8, 0.6, 0)));
  }
  return world.add(body);
}

/// The contacts that share the weight of a slider on a face.
double shares(Slider kind) {
  return kind == Slider::cube ? 4 : kind == Slider::capsule ? 2 : 1;
}

/// Checks that speed and heading are kept to 1e-3 of the speed. No force acts along the surface, and a single ghost
/// contact costs a tenth or more. A box on a seam has more contacts, each with the same stiffness, at one end than at
/// the other. So its ends may differ in depth, by at most the depth of one contact with the whole load: twice the sag.
/// Over a side that is an angle of 2 sag, and half of it in the quaternion.
void expect_slides_on(const World<6>& world, int body, const Vec3& heading, bool may_roll, double sag,
                      const std::string& when) {
  EXPECT_LT((world.v(body) - world.v(body).z() * Vec3::UnitZ() - speed * heading).norm(), 1e-3 * speed) << when;
  if (may_roll) return;
  EXPECT_LT(orientation(world, body).vec().norm(), sag) << when;
}

TEST(FlushBoxes, KeepSpeedInAnyDirectionAtAnyStepAndSag) {
  testing::Random random;
  for (const Slider kind : {Slider::cube, Slider::ball, Slider::capsule})
    for (const double rate : steps_per_second)
      for (const double sag : {1e-6, 1e-4, 1e-2}) {
        const double angle = random.uniform(0, 1.5);
        const Vec3 heading(std::cos(angle), std::sin(angle), 0);
        World<6> world({.k = 1e6});
        for (int a = -1; a < 7; ++a)
          for (int b = -1; b < 7; ++b) world.add_fixed_box(Vec3(a, b, -0.5), Vec3::Constant(0.5));
        const double depth = sag * 2 * half, mass = depth * shares(kind) * 1e6 / g;
        const int body = add_slider(world, kind, mass, heading, depth);
        for (int step = 0; step < 1.4 * rate; ++step) world.step(1 / rate);
        expect_slides_on(world, body, heading, kind != Slider::cube, sag,
                         "kind " + std::to_string(static_cast<int>(kind)) + ", " + std::to_string(rate) +
                             " steps a second, sag " + std::to_string(sag) + ", seed 11");
      }
}

TEST(FlushBoxes, KeepSpeedOfBodiesMuchLargerOrThinnerThanTheyAre) {
  // A hundredth of the ball's width is a fortieth of a box's, and 3 mm are a twenty-fifth of the capsule's radius.
  const Quat lying(Eigen::AngleAxisd(std::acos(-1) / 2, Vec3(1, 0.4, 0).normalized()));
  const Vec3 heading(std::cos(0.771), std::sin(0.771), 0);
  for (const double rate : steps_per_second)
    for (const bool is_ball : {true, false}) {
      World<6> world({.k = 1e6});
      for (int a = -1; a < 7; ++a)
        for (int b = -1; b < 7; ++b) world.add_fixed_box(Vec3(a, b, -0.5), Vec3::Constant(0.5));
      Body<6> body{.x = Vec3(0.1, 0.13, 0), .v = speed * heading};
      body.radius = is_ball ? 1.25 : 0.075;
      const double depth = is_ball ? 0.025 : 0.003;
      if (!is_ball) {
        body.half_length = 0.15;
        body.q = lying;
      }
      body.x.z() = body.radius - depth;
      body.mass = depth * (is_ball ? 1 : 2) * 1e6 / g;
      const int slider = world.add(body);
      for (int step = 0; step < 1.4 * rate; ++step) world.step(1 / rate);
      expect_slides_on(world, slider, heading, true, depth,
                       (is_ball ? "ball, " : "capsule, ") + std::to_string(rate) + " steps a second");
    }
}

TEST(FlushBoxes, KeepSpeedBesideAPlane) {
  for (const Slider kind : {Slider::cube, Slider::ball, Slider::capsule})
    for (const double rate : steps_per_second)
      for (const double sag : {1e-6, 1e-2}) {
        const double depth = sag * 2 * half;
        World<6> world({.k = 1e6});
        world.add_plane(Vec3::UnitZ(), 0);  // the surface continues below the boxes and beside them
        for (int a = 1; a < 4; ++a) world.add_fixed_box(Vec3(a, 0, -0.5), Vec3::Constant(0.5));
        const int body = add_slider(world, kind, depth * shares(kind) * 1e6 / g, Vec3::UnitX(), depth);
        for (int step = 0; step < 1.4 * rate; ++step) world.step(1 / rate);
        // Where plane and boxes both carry it, a body is lifted by up to half its sag: its speed along x does not
        // change.
        EXPECT_NEAR(world.v(body).x(), speed, 1e-3 * speed)
            << "kind " << static_cast<int>(kind) << ", " << rate << " steps a second, sag " << sag;
      }
}

TEST(FlushBoxes, KeepSpeedOnARowOfMovingOnes) {
  for (const double rate : steps_per_second)
    for (const double mass : {1.0, 100.0}) {
      World<6> world({.k = 1e6});
      world.add_plane(Vec3::UnitZ(), -1);
      std::vector<int> row;
      for (int a = -1; a < 8; ++a)
        row.push_back(world.add({.x = Vec3(a, 0, -0.5), .mass = 1e4, .half_sides = Vec3::Constant(0.5)}));
      const int body = add_slider(world, Slider::cube, mass, Vec3::UnitX(), 0);
      for (int step = 0; step < 1.4 * rate; ++step) world.step(1 / rate);
      EXPECT_NEAR(world.v(body).x(), speed, 1e-3 * speed) << rate << " steps a second, mass " << mass;
    }
}

/// Slides at 1 m/s over boxes, the last of which is higher by `higher`, and returns the smallest speed along x.
double slowest_over_step(Slider kind, double higher, double rate) {
  World<6> world({.k = 1e6});
  for (int a = -1; a < 3; ++a) world.add_fixed_box(Vec3(a, 0, -0.5), Vec3::Constant(0.5));
  world.add_fixed_box(Vec3(3, 0, higher - 0.5), Vec3::Constant(0.5));
  const int body = add_slider(world, kind, 1, 0.25 * Vec3::UnitX(), 0);
  double slowest = speed;
  for (int step = 0; step < 2.8 * rate; ++step) {
    world.step(1 / rate);
    slowest = std::min(slowest, world.v(body).x());
  }
  return slowest;
}

TEST(HigherBoxes, StillStopWhatSlides) {
  for (const double rate : steps_per_second) {
    const std::string when = std::to_string(rate) + " steps a second";
    EXPECT_LT(slowest_over_step(Slider::cube, 0.01, rate), 0.5) << when;
    for (const Slider kind : {Slider::cube, Slider::ball, Slider::capsule})
      EXPECT_LT(slowest_over_step(kind, 0.5, rate), 0.1) << "kind " << static_cast<int>(kind) << ", " << when;
  }
}

TEST(HigherBoxes, TakeFromABallWhatTheirEdgeTakes) {
  // The edge is at the angle θ before the lowest point, cos θ = 1 - s/R. The part of v along the edge's normal is lost,
  // and the climb of s takes 2 g s from the rest of v². In a step the ball comes nearer by up to v h, and θ is off by
  // as much over R: .005 rad, which changes cos θ by .005 sin θ = .0016.
  const double rate = 1000, s = 0.01, cosine = 1 - s / half;
  EXPECT_NEAR(slowest_over_step(Slider::ball, s, rate), std::sqrt(cosine * cosine - 2 * g * s), 0.002);
}

TEST(BrickWall, KeepsItsContactsBetweenBricksSideBySide) {
  World<6> world({.k = 1e6});
  world.add_plane(Vec3::UnitZ(), 0);
  const int courses = 4, bricks = 5;
  for (int c = 0; c < courses; ++c)
    for (int b = 0; b < bricks; ++b)
      world.add({.x = Vec3(0.4 * b + 0.19 * (c % 2), 0, 0.2 * c + 0.1),
                 .mass = 10,
                 .half_sides = Vec3(0.2, 0.1, 0.1)});
  for (int step = 0; step < 30; ++step) world.step(1.0 / 60);
  int beside = 0, below = 0;
  for (const Contact& contact : world.contacts()) ++(std::abs(contact.n.x()) > 0.5 ? beside : below);
  // Four contacts of each pair of neighbours, of each brick with the floor, and of each two bricks that overlap by
  // about half: with a half exactly, the last brick of a course could tip.
  EXPECT_EQ(beside, 4 * courses * (bricks - 1));
  EXPECT_EQ(below, 4 * bricks + 4 * (courses - 1) * (2 * bricks - 1));
}

TEST(Gap, TakesABoxThatFitsBetweenItsWalls) {
  World<6> world({.k = 1e6});
  for (const double side : {-1.0, 1.0}) world.add_fixed_box(Vec3(side * 0.7, 0, -0.5), Vec3(0.5, 1, 0.5));
  world.add_plane(Vec3::UnitZ(), -1);
  const int body = world.add({.x = Vec3(0, 0, 0.3), .mass = 1, .half_sides = Vec3::Constant(half)});
  for (int step = 0; step < 180; ++step) world.step(1.0 / 60);
  EXPECT_NEAR(world.x(body).z(), half - 1, 1e-4);  // mg/k is 1e-5
  EXPECT_NEAR(world.x(body).x(), 0, 1e-9);
}

/// Tells whether the contacts with the second of two flush boxes are ghosts, for a cube that rests on the first one.
/// `angle`: of their normal, from the vertical [rad].
bool is_ghost_of_the_second(double angle, int contacts_on_it, bool moves) {
  Shapes shapes;
  std::vector<PlacedSolid> placed;
  const auto add = [&](int body, const Vec3& x, double half_side, bool is_static) {
    const Vec3 half_sides = Vec3::Constant(half_side);
    shapes.add(body, Cuboid{half_sides}, is_static);
    placed.emplace_back(Box{.body = body, .x = x, .axes = Mat3::Identity(), .half_sides = half_sides});
  };
  add(0, Vec3(0, 0, -0.5), 0.5, !moves);
  add(1, Vec3(1, 0, -0.5), 0.5, !moves);
  add(2, Vec3(0.4, 0, half), half, false);
  const Vec3 n(-std::sin(angle), 0, std::cos(angle)), r = Vec3::Zero();
  std::vector<Contact> contacts = {{.i = 0, .j = 2, .n = Vec3::UnitZ(), .gap = -1e-3, .r_i = r, .r_j = r}};
  for (int k = 0; k < contacts_on_it; ++k)
    contacts.push_back({.i = 1, .j = 2, .n = n, .gap = -1e-3, .r_i = r, .r_j = r});
  const std::vector<bool> ghosts = ghost_contacts(shapes, placed, 3, contacts);
  return !ghosts.empty() && ghosts[1];
}

TEST(FlushBoxes, CarryABoxThatTheirFacesTouchWithALittleTilt) {
  for (const double angle : {0.0, 1e-3, 2e-3, 0.019})
    EXPECT_FALSE(is_ghost_of_the_second(angle, 4, true)) << angle;
  for (const double angle : {0.021, 1.0, 1.57}) EXPECT_TRUE(is_ghost_of_the_second(angle, 4, true)) << angle;
  // At an edge, or on a box that cannot tilt, the direction of the support is exact.
  for (const double angle : {2e-3, 0.019}) {
    EXPECT_TRUE(is_ghost_of_the_second(angle, 1, true)) << angle;
    EXPECT_TRUE(is_ghost_of_the_second(angle, 4, false)) << angle;
  }
}

TEST(FlushBoxes, CostNoMorePairs) {
  // A slider is tested against its neighbours alone, however long the row is.
  const auto pairs = [](int length) {
    World<6> world({.k = 1e6});
    for (int a = 0; a < length; ++a) world.add_fixed_box(Vec3(a, 0, -0.5), Vec3::Constant(0.5));
    add_slider(world, Slider::cube, 1, Vec3::UnitX(), 0);
    world.step(1.0 / 60);
    return world.report().pairs;
  };
  // Each further box of the row touches one more.
  EXPECT_EQ(pairs(81) - pairs(41), pairs(121) - pairs(81));
}

}  // namespace
}  // namespace spook::ghost_contacts_test
