// Wires that swing below and above the step limit of their tension, and wires that hang with too few sweeps.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "stepping.hpp"

namespace spook {
namespace {

using testing::step_on;

constexpr double g = 9.81;

/// `links` links, 1 m in all, along a direction; points of 1 kg, the last of mass `ratio`.
World<3> wire(int links, double ratio, const Vec3& along, double k, int sweeps) {
  World<3> world({.gravity = Vec3(0, 0, -g), .k = k, .solver_limits = {.max_sweeps = sweeps}});
  world.add_fixed(Vec3::Zero());
  for (int point = 1; point <= links; ++point) {
    world.add({.x = along * point / links, .mass = point == links ? ratio : 1});
    world.add_joint({.i = point - 1, .j = point, .length = 1.0 / links});
  }
  return world;
}

constexpr double angle = std::numbers::pi / 6;
const Vec3 aside(std::sin(angle), 0, -std::cos(angle));

/// The largest angle between a link and the next.
double bend(const World<3>& world) {
  double largest = 0;
  for (int point = 1; point + 1 < static_cast<int>(world.bodies().size()); ++point) {
    const Vec3 before = world.x(point) - world.x(point - 1), after = world.x(point + 1) - world.x(point);
    largest = std::max(largest, std::atan2(before.cross(after).norm(), before.dot(after)));
  }
  return largest;
}

double largest_step(int links, double ratio) {
  const double tension = (3 - 2 * std::cos(angle)) * (ratio + links - 1) * g;
  return 2 / std::sqrt(4 * tension * links);
}

TEST(SwingingWire, StaysStraightBelowTheStepOfItsTension) {
  // The transverse part of its own weight bends it by m g sin θ/(M g cos θ) at a point. Released straight it oscillates
  // about that, up to twice as far. Another factor of two is for links that do not oscillate together.
  for (const auto& [links, ratio] : {std::pair{5, 100.0}, {10, 30.0}, {10, 100.0}}) {
    const int sweeps = static_cast<int>((links - 1) * ratio * std::log(1e7));  // Eq. (6.12)
    World<3> world = wire(links, ratio, aside, 1e12, sweeps);
    const double h = 0.95 * largest_step(links, ratio);
    const int steps = static_cast<int>(1 / h);
    double largest = 0;
    EXPECT_EQ(step_on(world, h, steps, [&] { largest = std::max(largest, bend(world)); }), steps);
    EXPECT_LE(largest, 4 * std::tan(angle) / ratio) << links << " links, " << ratio << ":1";
    EXPECT_LE(world.x(links).x(), -0.3) << "the wire should swing across";
  }
}

TEST(SwingingWire, AboveThatStepIsFiniteOrReported) {
  for (const double ratio : {1e2, 1e5, 1e8})
    for (const double h : {1.4 * largest_step(10, ratio), 1.0 / 30}) {
      World<3> world = wire(10, ratio, aside, 1e12, 100);
      step_on(world, h, 1000);
    }
}

TEST(HangingWire, HasAStretchBoundedByItsSweeps) {
  // n sweeps make each link except the last a spring of k' = 4 n m/(h² (1+4d)) or stiffer, and its end swings to at
  // most twice Σ T/k'. A solver that does more in a sweep does better.
  struct Case {
    int links, sweeps;
    double ratio, h;
  };
  const double d = 3;
  for (const Case& c : {Case{10, 50, 10, 1.0 / 60}, Case{10, 50, 100, 1.0 / 60}, Case{10, 5, 100, 1.0 / 240},
                        Case{30, 50, 300, 1.0 / 240}, Case{100, 50, 100, 1.0 / 1000}}) {
    World<3> world = wire(c.links, c.ratio, -Vec3::UnitZ(), 1e15, c.sweeps);
    const double tensions = (c.links - 1) * (c.ratio + c.links / 2.0) * g;
    const double law = tensions * c.h * c.h * (1 + 4 * d) / (4 * c.sweeps);
    ASSERT_LT(law, 0.5) << "beyond the bound";
    const int steps = std::min(1000, static_cast<int>(5 / c.h));
    double longest = 0, shortest = infinity;
    EXPECT_EQ(step_on(world, c.h, steps,
                      [&] {
                        longest = std::max(longest, -world.x(c.links).z() - 1);
                        shortest = std::min(shortest, -world.x(c.links).z() - 1);
                      }),
              steps);
    EXPECT_LE(longest, 2 * law) << c.links << " links, " << c.ratio << ":1";
    EXPECT_GE(shortest, -1e-9);
  }
}

TEST(HangingWire, BeyondItsSweepsIsFiniteOrReported) {
  for (const double ratio : {1.0, 1e4, 1e8})
    for (const int links : {10, 1000}) {
      World<3> world = wire(links, ratio, -Vec3::UnitZ(), 1e12, 20);
      step_on(world, 1.0 / 30, links == 10 ? 1000 : 50);
    }
}

}  // namespace
}  // namespace spook
