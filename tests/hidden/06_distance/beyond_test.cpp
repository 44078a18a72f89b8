// Beyond chapter 06's own tests: exchanged ends, moved scenes, where the points and the mass are.
#include "06_distance/distance.hpp"
#include "exercise_test.hpp"
#include "stages.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(DistanceConstraint, "6.1 distance_constraint");
EXERCISE(BallJointConstraints, "6.2 ball_joint_constraints");
EXERCISE(Rope, "6.3 rope");
EXERCISE(Cloth, "6.4 cloth");
EXERCISE(StepJoints, "6.5 step_joints");

EXERCISE_TEST(DistanceConstraint, DoesNotAskWhichEndIsFirst) {
  Random random;
  const Attachment i{.body = 0, .x = random.vector(3), .r = random.vector()};
  const Attachment j{.body = 1, .x = random.vector(3) + Vec3(9, 0, 0), .r = random.vector()};
  const SpookParameters spook{.a = 2, .b = 0.5, .Sigma = 0.1};
  const Constraint<6> one = distance_constraint<6>(i, j, 4, spook);
  const Constraint<6> other = distance_constraint<6>(j, i, 4, spook);
  expect_near("gap [m]", "Eq. (6.2)", other.gap, one.gap, roundings(16, 20));
  expect_near_vector("block of the first body", "Eq. (6.3)", other.Gj, one.Gi, roundings(64, 5));
  expect_near_vector("block of the second body", "Eq. (6.3)", other.Gi, one.Gj, roundings(64, 5));
}

EXERCISE_TEST(BallJointConstraints, AreTheSameInAMovedScene) {
  Random random;
  Attachment i{.body = 0, .x = random.vector(3), .r = random.vector()};
  Attachment j{.body = 1, .x = random.vector(3), .r = random.vector()};
  const SpookParameters spook{.a = 2, .b = 0.5, .Sigma = 0.1};
  const auto before = ball_joint_constraints<6>(i, j, spook);
  const Vec3 gap = j.x + j.r - i.x - i.r, shift = random.vector(100);
  i.x += shift, j.x += shift;
  const auto after = ball_joint_constraints<6>(i, j, spook);
  for (std::size_t k = 0; k < 3; ++k) {
    expect_near("gap [m]", "Eq. (6.5)", after[k].gap, gap[static_cast<Eigen::Index>(k)], roundings(16, 200));
    expect_near_vector("block of j", "Eq. (6.6)", after[k].Gj, before[k].Gj, roundings(64, 300));
  }
}

Vec3 centre(const Net& net) {
  Vec3 sum = Vec3::Zero();
  double mass = 0;
  for (std::size_t k = 0; k < net.x.size(); ++k) sum += net.mass[k] * net.x[k], mass += net.mass[k];
  return sum / mass;
}

double total(const Net& net) {
  double mass = 0;
  for (const double part : net.mass) mass += part;
  return mass;
}

EXERCISE_TEST(Rope, HasItsMassInItsMiddle) {
  Random random;
  const Vec3 from = random.vector(3), to = random.vector(3) + Vec3(7, 0, 0);
  const double mass = random.log_uniform(0.1, 50);
  const int links = random.integer(1, 200);
  const Net net = rope(from, to, links, mass);
  expect_near("mass [kg]", "Eq. (6.10)", total(net), mass, roundings(4 * links, mass));
  expect_near_vector("centre of mass [m]", "Eq. (6.10)", centre(net), Vec3(0.5 * (from + to)),
                     roundings(8 * links, 10));
}

EXERCISE_TEST(Cloth, HasItsMassInItsMiddle) {
  Random random;
  const Vec3 corner = random.vector(3), u = random.vector(2) + Vec3(4, 0, 0);
  const Vec3 v = random.vector(2) + Vec3(0, 4, 0);
  const double mass = random.log_uniform(0.1, 50);
  const int cells_u = random.integer(1, 12), cells_v = random.integer(1, 12);
  const Net net = cloth(corner, u, v, cells_u, cells_v, mass);
  const double points = (cells_u + 1.0) * (cells_v + 1);
  expect_near("number of points", "Eq. (6.11)", static_cast<double>(net.x.size()), points, {0, "exact"});
  expect_near("mass [kg]", "Eq. (6.11)", total(net), mass, roundings(4 * points, mass));
  expect_near_vector("centre of mass [m]", "Eq. (6.11)", centre(net), Vec3(corner + 0.5 * (u + v)),
                     roundings(8 * points, 15));
}

/// Compares the two blocks with the rate of the gap, and all else with what was given.
void expect_constraint(const std::string& equation, const Constraint<6>& got, const Attachment& i,
                       const Attachment& j, const Vec3& along, double gap, const SpookParameters& spook) {
  Random random;
  const Twist<6> Wi = random.twist(), Wj = random.twist();
  const Vec3 u = Wj.head<3>() + Vec3(Wj.tail<3>()).cross(j.r) - Wi.head<3>() - Vec3(Wi.tail<3>()).cross(i.r);
  expect_near("rate of the gap, G W [m/s]", equation, got.Gi.dot(Wi) + got.Gj.dot(Wj), u.dot(along),
              roundings(200, 10));
  expect_near_vector("linear part of Gj", equation, Vec3(got.Gj.head<3>()), along, roundings(64));
  expect_near("gap [m]", equation, got.gap, gap, roundings(64, 20));
  expect_true("bodies and parameters are those given, and λ has no bounds", "Eq. (6.4)",
              got.i == i.body && got.j == j.body && got.lo == -infinity && got.hi == infinity &&
                  got.spook.a == spook.a && got.spook.b == spook.b && got.spook.Sigma == spook.Sigma);
}

EXERCISE_TEST(DistanceConstraint, IsRightLooseAndStretched) {
  Random random;
  for (int k = 0; k < 20; ++k) {
    const Attachment i{.body = k % 2 ? 4 : 1, .x = random.vector(3), .r = random.vector()};
    const Attachment j{.body = 2, .x = random.vector(3), .r = random.vector()};
    const SpookParameters spook{
        .a = random.uniform(1, 9), .b = random.uniform(0.1, 0.9), .Sigma = random.log_uniform(1e-9, 1)};
    const Vec3 apart = j.x + j.r - i.x - i.r;
    const double length = random.uniform(0.1, 8);
    if (apart.norm() < 0.1) continue;
    expect_constraint("Eq. (6.2), (6.3)", distance_constraint<6>(i, j, length, spook), i, j, apart.normalized(),
                      apart.norm() - length, spook);
    const Constraint<3> points = distance_constraint<3>(i, j, length, spook);
    expect_near_vector("Gi of point masses", "Eq. (6.3)", Vec3(points.Gi), Vec3(-apart.normalized()),
                       roundings(64 / apart.norm(), 5));
    expect_near("gap of point masses [m]", "Eq. (6.2)", points.gap, apart.norm() - length, roundings(16, 12));
    for (const double bad : {0.0, -1.0, std::nan("")})
      expect_rejects("length = " + std::to_string(bad), "length",
                     [&] { distance_constraint<6>(i, j, bad, spook); });
    expect_rejects("both points at one place", "distance", [&] { distance_constraint<6>(i, i, 1, spook); });
  }
}

EXERCISE_TEST(BallJointConstraints, AreTheRatesAlongTheAxes) {
  Random random;
  for (int k = 0; k < 20; ++k) {
    const Attachment i{.body = k % 2 ? 4 : 1, .x = random.vector(3), .r = random.vector()};
    const Attachment j{.body = 2, .x = random.vector(3), .r = random.vector()};
    const SpookParameters spook{
        .a = random.uniform(1, 9), .b = random.uniform(0.1, 0.9), .Sigma = random.log_uniform(1e-9, 1)};
    const auto rows = ball_joint_constraints<6>(i, j, spook);
    const auto points = ball_joint_constraints<3>(i, j, spook);
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<std::size_t>(axis);
      expect_constraint("Eq. (6.5), (6.6)", rows[at], i, j, Vec3::Unit(axis), (j.x + j.r - i.x - i.r)[axis],
                        spook);
      expect_near_vector("Gj of point masses", "Eq. (6.6)", Vec3(points[at].Gj), Vec3(Vec3::Unit(axis)),
                         {0, "exact"});
    }
  }
}

/// Points in a chain, or in a grid of rows of `width` points; each link as long as its points are apart.
void expect_links(const std::string& equation, const Net& net, int width) {
  std::vector<std::pair<int, int>> expected, found;
  for (int k = 0; k < std::ssize(net.x); ++k) {
    if ((k + 1) % width != 0) expected.emplace_back(k, k + 1);
    if (k + width < std::ssize(net.x)) expected.emplace_back(k, k + width);
  }
  for (const Link& link : net.links) {
    found.emplace_back(std::min(link.i, link.j), std::max(link.i, link.j));
    const double apart =
        (net.x[static_cast<std::size_t>(link.j)] - net.x[static_cast<std::size_t>(link.i)]).norm();
    expect_near("length of a link [m]", equation, link.length, apart, roundings(200, 20));
  }
  std::sort(found.begin(), found.end());
  std::sort(expected.begin(), expected.end());
  expect_true("each point has a link to its neighbours, once", equation, found == expected);
}

EXERCISE_TEST(Rope, HasItsPointsOnALine) {
  Random random;
  for (const int links : {1, 2, 7, many}) {
    const Vec3 from = random.vector(3), to = from + random.vector_of_length(0.5, 5);
    const double mass = random.log_uniform(0.1, 50);
    const Net net = rope(from, to, links, mass);
    expect_true("one point more than links", "Eq. (6.10)", std::ssize(net.x) == links + 1);
    if (std::ssize(net.x) != links + 1 || net.mass.size() != net.x.size()) return;
    for (int k = 0; k <= links; ++k) {
      const auto at = static_cast<std::size_t>(k);
      expect_near_vector("point " + std::to_string(k) + " [m]", "Eq. (6.10)", net.x[at],
                         Vec3(from + k * (to - from) / links), roundings(16, 10));
      const double part = k == 0 || k == links ? 0.5 : 1;
      expect_near("its mass [kg]", "Eq. (6.10)", net.mass[at], part * mass / links, roundings(16, mass));
    }
    expect_links("Eq. (6.10)", net, links + 1);
  }
  const Vec3 end(0, 0, 1), start(0, 0, 0);
  expect_rejects("no links", "links", [&] { rope(start, end, 0, 1); });
  expect_rejects("no mass", "mass", [&] { rope(start, end, 1, 0); });
  expect_rejects("no length", "length", [&] { rope(end, end, 1, 1); });
  expect_rejects("an end that is no number", "to", [&] { rope(start, Vec3(0, std::nan(""), 1), 1, 1); });
}

EXERCISE_TEST(Cloth, HasItsPointsInAGrid) {
  Random random;
  for (const int cells_u : {1, 3, 8})
    for (const int cells_v : {1, 5}) {
      const Vec3 corner = random.vector(3), u = Vec3(3, 0, 0) + random.vector(),
                 v = Vec3(0, 3, 0) + random.vector();
      const double mass = random.log_uniform(0.1, 50);
      const Net net = cloth(corner, u, v, cells_u, cells_v, mass);
      const int width = cells_u + 1;
      expect_true("a point at each corner of a cell", "Eq. (6.11)", std::ssize(net.x) == width * (cells_v + 1));
      if (std::ssize(net.x) != width * (cells_v + 1) || net.mass.size() != net.x.size()) return;
      for (int b = 0; b <= cells_v; ++b)
        for (int a = 0; a <= cells_u; ++a) {
          const auto at = static_cast<std::size_t>(a + b * width);
          expect_near_vector("a point [m]", "Eq. (6.11)", net.x[at],
                             Vec3(corner + a * u / cells_u + b * v / cells_v), roundings(16, 12));
          const double part = (a == 0 || a == cells_u ? 0.5 : 1) * (b == 0 || b == cells_v ? 0.5 : 1);
          expect_near("its mass [kg]", "Eq. (6.11)", net.mass[at], part * mass / cells_u / cells_v,
                      roundings(16, mass));
        }
      expect_links("Eq. (6.11)", net, width);
    }
  const Vec3 x(1, 0, 0), y(0, 1, 0);
  expect_rejects("no cells along u", "cells_u", [&] { cloth(x, x, y, 0, 1, 1); });
  expect_rejects("no cells along v", "cells_v", [&] { cloth(x, x, y, 1, 0, 1); });
  expect_rejects("no mass", "mass", [&] { cloth(x, x, y, 1, 1, 0); });
  expect_rejects("no area", "area", [&] { cloth(y, x, 2 * x, 1, 1, 1); });
}

EXERCISE_TEST(StepJoints, IsAStepOfAllRows) {
  Random random;
  auto [all, contacts] = crowd(random, 20, 30);
  open_every_third(contacts);
  all.mu = 0.4;
  all.viscosity = 1e3;
  for (int n = 0; n < 20; ++n) {
    const Vec3 p_i = random.vector(0.3), p_j = random.vector(0.3);
    all.joints.push_back({.i = (n + 1) % 20,
                          .j = n,
                          .p_i = p_i,
                          .p_j = p_j,
                          .length = n % 3 ? 0 : 0.7,
                          .k = random.uniform(100, 200),
                          .d = random.uniform(0.2, 0.3)});
  }
  const double h = random.uniform(0.05, 0.1);
  Simulation got = all;
  step_joints(got, contacts, h);
  expect_same_bodies("after a step with joints and contacts", "Eq. (6.1)-(6.6)", got,
                     assembled(all, contacts, h),
                     {1e-10, "roundings of 5 sweeps over some 200 rows, of impulses up to 100"});
}

}  // namespace
