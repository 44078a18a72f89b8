// Capsules: moments by quadrature, contacts against a dense search, and their rest, rolling and collisions.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/world/world.hpp"
#include "random_input.hpp"
#include "refusals.hpp"

namespace spook::capsules {

namespace {

constexpr double g = 9.81, pi = std::numbers::pi;

PlacedCapsule capsule(int body, const Vec3& x, const Vec3& axis, double radius, double half_length) {
  return {.body = body, .x = x, .axis = axis.normalized(), .radius = radius, .half_length = half_length};
}

/// Draws a capsule whose centre is within `reach` of the origin along each axis.
PlacedCapsule some_capsule(testing::Random& random, int body, double reach) {
  const Vec3 x = random.vector(reach), axis = random.unit_vector();
  const double radius = random.uniform(0.05, 0.5), half_length = random.uniform(0.1, 1.5);
  return capsule(body, x, axis, radius, half_length);
}

/// Returns the distance of a point from a box, negative inside.
double distance(const Box& box, const Vec3& point) {
  const Vec3 beyond = (box.axes.transpose() * (point - box.x)).cwiseAbs() - box.half_sides;
  return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

double distance(const PlacedCapsule& other, const Vec3& point) {
  const double along = std::clamp(other.axis.dot(point - other.x), -other.half_length, other.half_length);
  return (point - other.x - along * other.axis).norm() - other.radius;
}

/// Returns the smallest gap over 20,001 balls along the capsule [m].
template <class Other>
double smallest_gap(const Other& other, const PlacedCapsule& c) {
  double least = infinity;
  for (int n = 0; n <= 20'000; ++n) least = std::min(least, distance(other, c.ball(n / 1e4 - 1).x) - c.radius);
  return least;
}

double deepest(const std::vector<Contact>& contacts) {
  double least = infinity;
  for (const Contact& contact : contacts) least = std::min(least, contact.gap);
  return least;
}

/// Expects unit normals, lever arms to one point, and a gap that changes correctly when j moves.
void expect_sound(const std::vector<Contact>& contacts, const Vec3& x_i, const Vec3& x_j) {
  EXPECT_LE(contacts.size(), 3U);
  for (const Contact& contact : contacts) {
    EXPECT_NEAR(contact.n.norm(), 1, 1e-12);
    EXPECT_NEAR((x_i + contact.r_i - x_j - contact.r_j).norm(), 0, 1e-12 * (1 + x_j.norm()));
    EXPECT_LE(contact.gap, 0);
  }
}

}  // namespace

TEST(Capsule, HasTheMomentsOfItsVolume) {
  testing::Random random;
  for (int draw = 0; draw < 5; ++draw) {
    const double m = random.log_uniform(0.1, 10), r = random.log_uniform(0.1, 1),
                 L = random.log_uniform(0.01, 3);
    // Discs of thickness dz: of radius ρ, dm = c ρ² dz, with ρ²/2 about z and ρ²/4 + z² across. Midpoints, 1e-8.
    const int discs = 200'000;
    double mass = 0, about_z = 0, across = 0;
    for (int n = 0; n < discs; ++n) {
      const double z = (2 * (n + 0.5) / discs - 1) * (L + r), over = std::max(std::abs(z) - L, 0.0);
      const double square = r * r - over * over;
      mass += square, about_z += square * square / 2, across += square * (square / 4 + z * z);
    }
    const Vec3 moments = solid_capsule_moments(m, r, L);
    EXPECT_NEAR(moments.z(), m * about_z / mass, 1e-8 * moments.z()) << "r = " << r << ", L = " << L;
    EXPECT_NEAR(moments.x(), m * across / mass, 1e-8 * moments.x()) << "r = " << r << ", L = " << L;
  }
  EXPECT_TRUE(solid_capsule_moments(2, 0.3, 0).isApprox(solid_sphere_moments(2, 0.3), 1e-14));
}

TEST(Capsule, IsAsDeepInABoxAsADenseSearchFinds) {
  testing::Random random;
  int touched = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const Box box{.body = 0,
                  .x = random.vector(1),
                  .axes = random.rotation().toRotationMatrix(),
                  .half_sides = random.vector(0.2, 1)};
    const PlacedCapsule c = some_capsule(random, 1, 1.5);
    std::vector<Contact> contacts;
    add_contacts(box, c, contacts);
    const double gap = smallest_gap(box, c);
    // The signed distance changes by 1e-4 half lengths from one ball of the search to the next.
    const double close = 1.5e-4;
    EXPECT_TRUE(contacts.empty() || gap <= close) << "gap " << gap << ", draw " << draw;
    EXPECT_TRUE(!contacts.empty() || gap >= -close) << "gap " << gap << ", draw " << draw;
    EXPECT_NEAR(contacts.empty() ? gap : deepest(contacts), gap, close) << "draw " << draw;
    expect_sound(contacts, box.x, c.x);
    touched += !contacts.empty();
  }
  EXPECT_GT(touched, 50);
}

TEST(Capsule, IsAsDeepInAnotherAsADenseSearchFinds) {
  testing::Random random;
  int touched = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const PlacedCapsule a = some_capsule(random, 0, 1);
    const PlacedCapsule b = some_capsule(random, 1, 1);
    std::vector<Contact> contacts;
    add_contacts(a, b, contacts);
    const double gap = smallest_gap(a, b), close = 1.5e-4;
    EXPECT_TRUE(contacts.empty() || gap <= close) << "gap " << gap << ", draw " << draw;
    EXPECT_TRUE(!contacts.empty() || gap >= -close) << "gap " << gap << ", draw " << draw;
    EXPECT_NEAR(contacts.empty() ? gap : deepest(contacts), gap, close) << "draw " << draw;
    expect_sound(contacts, a.x, b.x);
    touched += !contacts.empty();
  }
  EXPECT_GT(touched, 50);
}

TEST(Capsule, StandsOnTwoPointsWhereItLies) {
  const Box table{.body = 0, .x = Vec3::Zero(), .axes = Mat3::Identity(), .half_sides = Vec3(1, 1, 0.5)};
  const auto on_table = [&](const Vec3& x, double half_length) {
    std::vector<Contact> contacts;
    add_contacts(table, capsule(1, x, Vec3::UnitX(), 0.2, half_length), contacts);
    return contacts;
  };
  // Within the face, over both of its sides, over one, and along its rim: the ends of the part on the face.
  for (const auto& [x, half_length, from, to] :
       {std::tuple(Vec3(0.1, 0, 0.699), 0.5, -0.4, 0.6), std::tuple(Vec3(0.1, 0, 0.699), 2.0, -1.0, 1.0),
        std::tuple(Vec3(0.8, 0, 0.699), 0.5, 0.3, 1.0), std::tuple(Vec3(0.1, 1.1, 0.67), 0.5, -0.4, 0.6)}) {
    const std::vector<Contact> contacts = on_table(x, half_length);
    ASSERT_EQ(contacts.size(), 2U) << "half length " << half_length;
    EXPECT_NEAR(contacts[0].r_i.x(), from, 1e-12);
    EXPECT_NEAR(contacts[1].r_i.x(), to, 1e-12);
    EXPECT_NEAR(contacts[0].gap, contacts[1].gap, 1e-12);
  }
  std::vector<Contact> parallel;
  add_contacts(capsule(0, Vec3::Zero(), Vec3::UnitX(), 0.3, 1),
               capsule(1, Vec3(0.5, 0, 0.59), Vec3::UnitX(), 0.3, 1), parallel);
  ASSERT_EQ(parallel.size(), 2U);
  EXPECT_NEAR(std::min(parallel[0].r_i.x(), parallel[1].r_i.x()), -0.5, 1e-12);
  EXPECT_NEAR(std::max(parallel[0].r_i.x(), parallel[1].r_i.x()), 1, 1e-12);
}

TEST(Capsule, RestsAsDeepAsItsSpringsSay) {
  // On a plane and on a box, lying and standing: each of n contacts carries m g/n.
  const double k = 1e5, m = 2, h = 1.0 / 120;
  for (const bool on_box : {false, true})
    for (const bool standing : {false, true}) {
      World<6> world({.gravity = Vec3(0, 0, -g), .k = k});
      if (on_box)
        world.add_fixed_box(Vec3(0, 0, -0.5), Vec3(2, 2, 0.5));
      else
        world.add_plane(Vec3::UnitZ(), 0);
      const double half = 0.4, r = 0.1;
      const Quat q = standing ? Quat::Identity() : Quat(Eigen::AngleAxisd(pi / 2, Vec3::UnitY()));
      const int body = world.add(
          {.x = Vec3(0, 0, r + (standing ? half : 0)), .mass = m, .radius = r, .q = q, .half_length = half});
      for (int n = 0; n < 600; ++n) world.step(h);
      const double sag = r + (standing ? half : 0) - world.x(body).z(), contacts = standing ? 1 : 2;
      EXPECT_NEAR(sag, m * g / (contacts * k), 1e-9) << (on_box ? "on a box" : "on a plane");
      EXPECT_LT(world.v(body).norm(), 1e-9);
    }
}

TEST(Capsule, RollsDownASlopeAsItsInertiaSays) {
  // a = g sin α/(1 + I/(m r²)): without slip, as tan α < 3 μ.
  const double alpha = 0.2, r = 0.1, half = 0.3, m = 1, h = 1.0 / 1000;
  const Vec3 n(std::sin(alpha), 0, std::cos(alpha)), down(std::cos(alpha), 0, -std::sin(alpha));
  World<6> world({.gravity = Vec3(0, 0, -g), .k = 1e8, .friction = 1});
  world.add_plane(n, 0);
  const int body = world.add({.x = r * n,
                              .mass = m,
                              .radius = r,
                              .q = Quat(Eigen::AngleAxisd(-pi / 2, Vec3::UnitX())),
                              .half_length = half});
  const double I = solid_capsule_moments(m, r, half).z(), a = g * std::sin(alpha) / (1 + I / (m * r * r));
  for (int step = 0; step < 1000; ++step) world.step(h);
  // Its velocity is half a step ahead, since it starts without the half step back: a t h/2 of a t²/2, which is 1e-3.
  EXPECT_NEAR(world.x(body).dot(down), a / 2, 2e-3 * a / 2);
}

TEST(Capsule, OverhangingATableStaysAndTips) {
  // It tips where its centre is beyond the rim.
  const double h = 1.0 / 240;
  for (const double beyond : {-0.05, 0.05}) {
    World<6> world({.gravity = Vec3(0, 0, -g), .k = 1e6, .friction = 0.5});
    world.add_fixed_box(Vec3(-1, 0, -0.5), Vec3(1, 1, 0.5));
    const int body = world.add({.x = Vec3(beyond, 0, 0.1),
                                .mass = 1,
                                .radius = 0.1,
                                .q = Quat(Eigen::AngleAxisd(pi / 2, Vec3::UnitY())),
                                .half_length = 0.5});
    for (int n = 0; n < 480; ++n) world.step(h);
    if (beyond < 0)
      EXPECT_NEAR(world.x(body).z(), 0.1, 1e-3);
    else
      EXPECT_LT(world.x(body).z(), -0.5);
  }
}

TEST(Capsule, PartsAcrossTheAxesOfTwoInOnePlace) {
  // Along an axis they would have to move by a length, and not by two radii.
  const double radius = 0.2;
  testing::Random random;
  for (const double angle : {0.0, 1e-12, 0.3, pi / 2}) {
    World<6> world({.gravity = Vec3::Zero()});
    const Quat q = random.rotation();
    const Vec3 x = random.vector(10);
    for (const double turn : {0.0, angle})
      world.add({.x = x,
                 .mass = 1,
                 .radius = radius,
                 .q = q * Quat(Eigen::AngleAxisd(turn, Vec3::UnitX())),
                 .half_length = 0.3});
    for (int n = 0; n < 60; ++n) world.step(1.0 / 60);
    const Vec3 apart = world.x(1) - world.x(0);
    const std::string where =
        "axes at " + std::to_string(angle) + " rad, seed " + std::to_string(random.seed());
    EXPECT_NEAR(apart.norm(), 2 * radius, 1e-3 * radius) << where;
    for (const int body : {0, 1})
      EXPECT_NEAR(apart.dot(world.bodies().orientations.q[world.index(body)] * Vec3::UnitZ()), 0, 1e-6 * radius)
          << where;
  }
}

TEST(Capsule, KeepsMomentaWhenTwoCollide) {
  const double h = 1.0 / 500;
  testing::Random random;
  World<6> world(
      {.gravity = Vec3::Zero(), .k = 1e6, .impacts = ImpactLaw{.restitution = 0.5, .friction = 0.3}});
  for (int k = 0; k < 2; ++k) {
    const Vec3 x(k ? 0.6 : -0.6, 0.1 * k, 0.05 * k);
    world.add(
        {.x = x, .v = -2 * x, .mass = 1.0 + k, .radius = 0.2, .q = random.rotation(), .half_length = 0.3});
  }
  const auto momentum = [&] {
    Vec3 sum = Vec3::Zero();
    for (int body = 0; body < 2; ++body) sum += world.bodies().mass[world.index(body)] * world.v(body);
    return sum;
  };
  const Vec3 before = momentum();
  int contacts = 0;
  for (int n = 0; n < 1000; ++n) {
    world.step(h);
    contacts += static_cast<int>(world.contacts().size());
  }
  EXPECT_GT(contacts, 0) << "they should meet (seed " << testing::Random::seed() << ")";
  EXPECT_LT((momentum() - before).norm(), 1e-12);
}

TEST(Capsule, PushesABallOnItsSegmentAcross) {
  for (const bool ball_first : {false, true})
    for (const double angle : {0.0, 0.7, 1.5708}) {
      World<6> world({.gravity = Vec3::Zero()});
      const Body<6> ball{.mass = 1, .radius = 0.1};
      if (ball_first) world.add(ball);
      const Quat q(Eigen::AngleAxisd(angle, Vec3::UnitY()));
      world.add_fixed(Vec3::Zero(), Capsule{.radius = 0.1, .half_length = 1}, q);
      if (!ball_first) world.add(ball);
      world.step(1.0 / 60);
      ASSERT_EQ(world.contacts().size(), 1u);
      EXPECT_LT(std::abs(world.contacts()[0].n.dot(q * Vec3::UnitZ())), 1e-9) << angle;
      EXPECT_NEAR(world.contacts()[0].gap, -0.2, 1e-12);
    }
}

TEST(Capsule, RefusesInvalidShapes) {
  World<6> world({});
  expect_refusal({"half_length", "-1"}, [&] { world.add({.radius = 0.1, .half_length = -1}); });
  expect_refusal({"radius", "0"}, [&] { world.add({.principal = Vec3::Ones(), .half_length = 1}); });
  expect_refusal({"radius", "half_sides"},
                 [&] { world.add({.radius = 0.1, .half_length = 1, .half_sides = Vec3::Ones()}); });
  expect_refusal({"radius", "-1"}, [&] { world.add_fixed(Vec3::Zero(), Capsule{-1, 1}, Quat::Identity()); });
  expect_refusal({"shape", "points"},
                 [&] { world.add_fixed(Vec3::Zero(), PointSet{{Vec3::UnitX()}}, Quat::Identity()); });
  EXPECT_EQ(world.bodies().size(), 0U);
}

}  // namespace spook::capsules
