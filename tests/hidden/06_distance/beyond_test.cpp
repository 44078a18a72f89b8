// Beyond chapter 06's own tests: exchanged ends, moved scenes, and where the mass is.
#include "06_distance/distance.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(DistanceConstraint, "6.1 distance_constraint");
EXERCISE(BallJointConstraints, "6.2 ball_joint_constraints");
EXERCISE(Rope, "6.3 rope");
EXERCISE(Cloth, "6.4 cloth");

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

}  // namespace
