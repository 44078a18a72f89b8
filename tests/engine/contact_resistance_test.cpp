// Resistance to rolling and torsion: closed forms of a ball and a capsule.
#include "engine/constraints/contact_resistance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/solvers/registry.hpp"
#include "engine/world/world.hpp"

namespace spook {
namespace {

constexpr double g = 9.81, r = 0.1, rho = 0.002;

Body<6> ball(const Vec3& x = Vec3(0, 0, r)) {
  return {.x = x, .mass = 1, .radius = r};
}

World<6> plane(const Vec3& gravity = Vec3(0, 0, -g)) {
  World<6> world({.gravity = gravity, .friction = 0.6});
  world.add_plane(Vec3::UnitZ(), 0);
  return world;
}

Vec3 omega_of(const World<6>& world, int body) {
  return world.bodies().motion.W[static_cast<std::size_t>(body)].tail<3>();
}

// It rolls to v²/2a with a = ρ g r/(r² + I/m). In its first step it has no resistance, and it stops within the last one:
// two steps' ways at most.
TEST(ContactResistance, WhatRollsComesToRest) {
  for (const double h : {1.0 / 60, 1.0 / 240})
    for (const bool capsule : {false, true}) {
      World<6> world = plane();
      Body<6> body = ball();
      body.v = Vec3(1, 0, 0);
      body.omega = Vec3(0, 1 / r, 0);
      if (capsule) {
        body.half_length = 0.2;
        body.q = Quat(Eigen::AngleAxisd(std::acos(0.0), Vec3::UnitX()));
      }
      const int n = world.add(body);
      world.set_material(n, {.rolling_resistance = rho});
      const double I = 1 / world.bodies().orientations.inverse_inertia(static_cast<std::size_t>(n))(1, 1);
      const double a = rho * g * r / (I + r * r);
      while (world.time() < 12) world.step(h);
      EXPECT_NEAR(world.x(n).x(), 1 / (2 * a), 2 * h) << h;
      EXPECT_LT(world.v(n).norm(), 1e-9);
      EXPECT_LT(omega_of(world, n).norm(), 1e-8);
    }
}

// At rest up to tan θ = ρ/r; above it, 5/7 of what the slope gives more than the resistance. The ball begins in its first
// step, which has no resistance.
TEST(ContactResistance, ABallRestsOnAGentleSlope) {
  const double h = 1.0 / 240;
  for (const double share : {0.5, 0.95, 2.0}) {
    const double slope = std::atan(share * rho / r);
    World<6> world = plane(g * Vec3(std::sin(slope), 0, -std::cos(slope)));
    const int n = world.add(ball());
    world.set_material(n, {.rolling_resistance = rho});
    while (world.time() < 5) world.step(h);
    const double a = share < 1 ? 0 : 5.0 / 7 * (g * std::sin(slope) - rho * g * std::cos(slope) / r);
    EXPECT_NEAR(world.v(n).x(), a * world.time(), share < 1 ? 1e-9 : 2 * g * std::sin(slope) * h) << share;
  }
}

TEST(ContactResistance, WhatSpinsIsSlowedByTorsion) {
  World<6> world = plane();
  Body<6> top = ball();
  top.omega = Vec3(0, 0, 5);
  const int n = world.add(top);
  world.set_material(0, n, {.torsional_resistance = rho});
  const double h = 1.0 / 1000, slowing = rho * g / (0.4 * r * r);
  while (world.time() < 0.5) world.step(h);
  EXPECT_NEAR(omega_of(world, n).z(), 5 - slowing * 0.5, 2 * slowing * h);
  EXPECT_LT(world.v(n).norm(), 1e-9);
}

TEST(ContactResistance, HoldsWhateverIsAddedFirst) {
  // A column of balls: contacts with the plane come first in a step, whatever the plane's number.
  const auto rows = [](bool plane_first) {
    World<6> world({.friction = 0.6});
    if (plane_first) world.add_plane(Vec3::UnitZ(), 0);
    const int lowest = world.add(ball());
    for (const double z : {0.3, 0.5, 0.7}) world.add(ball(Vec3(0, 0, z)));
    if (!plane_first) world.add_plane(Vec3::UnitZ(), 0);
    world.set_material(lowest, {.rolling_resistance = rho});
    for (int n = 0; n < 5; ++n) world.step(1.0 / 60);
    EXPECT_EQ(world.contacts().size(), 4u);
    return world.rows().size();
  };
  EXPECT_EQ(rows(true), 4u * 3 + 2 * 2) << "two rows resist at each of the lowest ball's contacts";
  EXPECT_EQ(rows(false), rows(true));
}

TEST(ContactResistance, LeavesNoRowOutOfASweep) {
  // Without an update the contact would not carry the ball.
  for (const RowOrder order : {RowOrder::up, RowOrder::down}) {
    World<6> world({.friction = 0.6, .solver = ordered_gauss_seidel<6>(order)});
    world.add_plane(Vec3::UnitZ(), 0);
    for (const double x : {0.0, 1.0}) {
      Body<6> rolling = ball(Vec3(x, 0, r));
      rolling.v = Vec3(0, 1, 0);
      rolling.omega = Vec3(-1 / r, 0, 0);
      world.set_material(world.add(rolling), {.rolling_resistance = rho});
    }
    while (world.time() < 1) world.step(1.0 / 60);
    for (const int n : {1, 2}) EXPECT_NEAR(world.x(n).z(), r, 1e-4) << "order " << static_cast<int>(order);
  }
}

TEST(ContactResistance, CostsNothingWhereNoMaterialHasIt) {
  World<6> world = plane();
  const int n = world.add(ball());
  world.set_material(n, {.friction = 0.3, .rolling_resistance = 0});
  for (int k = 0; k < 3; ++k) world.step(0.01);
  EXPECT_EQ(world.rows().size(), 3u);
}

TEST(ContactResistance, IsRefusedWhereThereIsNone) {
  const auto told = [](auto&& world, const Material& material) {
    const int n = world.add({.x = Vec3(0, 0, 1), .mass = 1, .radius = r});
    try {
      world.set_material(n, material);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(told(World<3>({}), {.rolling_resistance = 1}).find("rolling_resistance must be 0: a point"),
            std::string::npos);
  EXPECT_NE(told(World<6>({.soft_steps = SoftSteps{}}), {.torsional_resistance = 1}).find("soft steps"),
            std::string::npos);
  EXPECT_NE(told(World<6>({.integrator_order = 4}), {.rolling_resistance = 1}).find("order four"),
            std::string::npos);
  EXPECT_NE(told(World<6>({}), {.rolling_resistance = -1}).find("rolling_resistance must be zero or positive"),
            std::string::npos);
}

}  // namespace
}  // namespace spook
