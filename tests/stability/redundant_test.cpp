// Redundant rows: a box on a hundred contacts, and a loop that cannot close.
#include <algorithm>
#include <cmath>

#include "stepping.hpp"

namespace spook {
namespace {

using testing::step_on;

constexpr double g = 9.81;

World<6> box_on_a_hundred(double k, int sweeps) {
  World<6> world({.gravity = Vec3(0, 0, -g), .k = k, .solver_limits = {.max_sweeps = sweeps}});
  world.add_plane(Vec3::UnitZ(), 0);
  const Vec3 half(0.5, 0.5, 0.2);
  std::vector<Vec3> corners;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j) corners.emplace_back(i / 9.0 - 0.5, j / 9.0 - 0.5, -half.z());
  world.add(
      {.x = Vec3(0, 0, half.z()), .mass = 2, .principal = solid_box_moments(2, half), .corners = corners});
  return world;
}

TEST(FlatBox, OnAHundredContactsIsHeldByTheirSum) {
  // At rest W = 0 and G V = h g. So the residual of a row is r = -a gap - Σ λ, and the means of λ and r determine the
  // mean depth, with h m g/100 for λ. So the depth has an error of at most max|r|/a. As the λ have no torque, a tilt
  // over x has an error of Σ r x/Σ x², over a.
  const double h = 1.0 / 60, m = 2, u = std::ldexp(1, -55);
  double x_over_x2 = 0, x2 = 0;
  for (int i = 0; i < 10; ++i) {
    x_over_x2 += std::abs(i / 9.0 - 0.5);
    x2 += std::pow(i / 9.0 - 0.5, 2);
  }
  x_over_x2 /= x2;
  for (const auto& [k, sweeps] : {std::pair{1e3, 2000}, {1e4, 200}, {1e6, 200}, {1e8, 200}, {1e10, 200}}) {
    World<6> world = box_on_a_hundred(k, sweeps);
    EXPECT_EQ(step_on(world, h, 60), 60);
    ASSERT_EQ(world.contacts().size(), 100U) << "k " << k;
    double sum = 0;
    for (int c = 0; c < 100; ++c) {
      EXPECT_GT(world.lambda(c), 0) << "contact " << c;
      sum += world.lambda(c);
    }
    EXPECT_NEAR(sum / (h * m * g), 1, 1e-10) << "k " << k << ": the remaining velocity after 60 steps";
    const double lacks = world.report().residual / spook_parameters(h, k, 3).a;
    const double right = m * g / (100 * k), roundings = 10 * u + 1e-10 * right;
    EXPECT_NEAR(0.2 - world.x(1).z(), right, lacks + roundings) << "k " << k;
    const Vec3 up = orientation(world, 1) * Vec3::UnitZ();
    EXPECT_LE(up.head<2>().cwiseAbs().maxCoeff(), lacks * x_over_x2 + 10 * roundings) << "k " << k;
    if (k == 1e3) {
      EXPECT_LE(lacks, 1e-6 * right) << "softness selects a solution, and 2000 sweeps find it";
    }
  }
}

TEST(Loop, ThatCannotCloseRestsAtAWeightedMean) {
  // Two rods of 1 m and 1.1 m from one anchor. E of Eq. (4.2) has one nonzero eigenvalue, ρ. At rest n sweeps from λ =
  // 0 give two impulses that sum to 0 where x is the mean with the weights below. As ρⁿ goes to 0 the weights go to k₁
  // and k₂, for any d of either; before that the last row dominates. Factors find the mean with the weights k₁ and k₂.
  struct Case {
    double k1, k2, h = 1.0 / 60, d1 = 3, d2 = 3;
  };
  std::vector<Case> cases = {{1e2, 1e2}, {1e6, 2e6}, {1e6, 1e2}, {1e2, 1e6}, {1e9, 3e9}, {1e12, 1e12}};
  for (const double h : {1.0 / 60, 1.0 / 240})
    for (const double d2 : {0.5, 3.0, 8.0}) cases.push_back({2e3, 5e3, h, 2, d2});
  const double l1 = 1, l2 = 1.1;
  for (const auto& [k1, k2, h, d1, d2] : cases)
    for (const int sweeps : {1, 10, 1000}) {
      World<3> world({.gravity = Vec3::Zero(), .solver_limits = {.max_sweeps = sweeps}});
      world.add_fixed(Vec3::Zero());
      world.add({.x = Vec3(1.05, 0, 0)});
      world.add_joint({.i = 0, .j = 1, .length = l1, .k = k1, .d = d1});
      world.add_joint({.i = 1, .j = 0, .length = l2, .k = k2, .d = d2});
      EXPECT_EQ(step_on(world, h, 2000), 2000);
      const auto [a1, b1, c1] = spook_parameters(h, k1, d1);
      const auto [a2, b2, c2] = spook_parameters(h, k2, d2);
      const double left = std::exp(-sweeps * (std::log1p(c1) + std::log1p(c2)));  // ρⁿ
      const double w1 = a1 * c2 * (1 - left), w2 = a2 * (c1 + (1 + c1) * c2 * left);
      const double x = (w1 * l1 + w2 * l2) / (w1 + w2);
      const double right = (k1 * l1 + k2 * l2) / (k1 + k2);
      const auto which = ::testing::Message()
                         << k1 << ", " << k2 << ", h " << h << ", d " << d2 << ", " << sweeps;
      EXPECT_LE(std::abs(world.x(1).x() - right), std::abs(x - right) + 1e-14) << which;
      EXPECT_GE(world.x(1).x(), l1) << which;
      EXPECT_LE(world.x(1).x(), l2) << which;
      // The first pulls back a point that is too far.
      const double lambda = -h * k1 * (right - l1), roundings = 1e-10 + 1e-14 / std::min(c1, c2);
      EXPECT_NEAR(world.joint_lambda(0) / lambda, 1, roundings) << which;
      EXPECT_NEAR(world.joint_lambda(1) / lambda, -1, roundings) << which;
    }
}

}  // namespace
}  // namespace spook
