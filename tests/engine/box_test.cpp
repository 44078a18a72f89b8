// Rigid boxes on planes: contacts at corners.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/bodies/conserved_quantities.hpp"
#include "engine/world/world.hpp"
#include "random_input.hpp"

namespace spook::box_test {
namespace {

constexpr double g = 9.81, h = 1.0 / 60;
const Vec3 half(0.5, 0.3, 0.2);
constexpr double m = 2;

struct Drop {
  std::string name;
  Quat q;
};

Quat turned(double degrees, const Vec3& axis) {
  return Quat(Eigen::AngleAxisd(degrees * 3.14159265358979323846 / 180, axis.normalized()));
}

/// The deviation of the box's highest face from the horizontal: 0 when it lies on a face.
double tilt(const Quat& q) {
  return 1 - (q.conjugate() * Vec3::UnitZ()).cwiseAbs().maxCoeff();
}

/// Sums to h m g when the box is at rest.
Vec3 support(const World<6>& world) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t c = 0; c < world.contacts().size(); ++c) sum += world.impulse(static_cast<int>(c));
  return sum;
}

World<6> box_above_floor(const std::optional<ImpactLaw>& impacts, double k, const Quat& q,
                         const Vec3& v = Vec3::Zero(), const Vec3& omega = Vec3::Zero()) {
  World<6> world({.k = k, .friction = 0.5, .impacts = impacts, .solver_limits = {.max_sweeps = 200}});
  world.add_plane(Vec3::UnitZ(), 0);
  world.add({.x = Vec3(0, 0, 1),
             .v = v,
             .mass = m,
             .q = q,
             .omega = omega,
             .principal = solid_box_moments(m, half),
             .corners = box_corners(half)});
  return world;
}

void expect_rest_on_a_face(const World<6>& world, double k) {
  ASSERT_EQ(world.contacts().size(), 4U);
  EXPECT_LE(kinetic_energy(world.bodies()), 1e-10);
  EXPECT_LE(tilt(orientation(world, 1)), 1e-10);
  EXPECT_LE((support(world) - h * m * Vec3(0, 0, g)).norm(), 1e-5 * h * m * g);
  for (const Contact& contact : world.contacts())
    EXPECT_NEAR(contact.gap, -m * g / (4 * k), 1e-2 * m * g / (4 * k)) << "m g/(k N)";
}

TEST(Box, IsTurnedByWhatPushesItsCorner) {
  // About the point of the impulse the angular momentum is constant: for gap and friction, for impact or row.
  testing::Random random;
  for (int trial = 0; trial < 40; ++trial) {
    const bool hits = trial % 2 == 0;
    const Quat q = random.rotation();
    double lowest = 0;
    for (const Vec3& corner : box_corners(half)) lowest = std::min(lowest, (q * corner).z());
    const Vec3 x(0.3, -0.2, -lowest - 1e-9), v = random.vector(1) - Vec3(0, 0, 2), omega = random.vector(0.5);
    World<6> world(
        {.gravity = Vec3::Zero(),
         .impacts = hits ? std::optional(ImpactLaw{.restitution = 0.4, .friction = 0.3}) : std::nullopt});
    world.add_plane(Vec3::UnitZ(), 0);
    world.add({.x = x,
               .v = v,
               .mass = m,
               .q = q,
               .omega = omega,
               .principal = solid_box_moments(m, half),
               .corners = box_corners(half)});
    const auto spin = [&] { return Vec3(angular_momentum(world.bodies()) - m * world.x(1).cross(world.v(1))); };
    const Vec3 spin_before = spin();
    world.step(h);
    ASSERT_EQ(world.contacts().size(), 1U);
    ASSERT_EQ(world.report().impacts, hits ? 1 : 0);
    const Vec3 pushed = m * (world.v(1) - v);
    EXPECT_GE(pushed.norm(), 0.1);
    // An impact is detected 1e-9 m over the approach too late. Its lever arms differ by that, and by at most three
    // times that.
    EXPECT_LE((spin() - spin_before - world.contacts()[0].r_j.cross(pushed)).norm(),
              hits ? 3e-9 * pushed.norm() : 1e-12)
        << "trial " << trial;
    const Vec3 corner = q.conjugate() * world.contacts()[0].r_j;
    EXPECT_LE((corner.cwiseAbs() - half).norm(), 1e-12)
        << "r is from the centre to the corner, in the present orientation";
  }
}

TEST(Box, DroppedOnAFaceAnEdgeOrACornerComesToRestOnAFace) {
  const double k = 1e4;  // on which the sweeps share the load among four corners
  for (const std::optional<ImpactLaw>& impacts :
       {std::optional<ImpactLaw>(), std::optional(ImpactLaw{.friction = 0.5})})
    for (const Drop& drop :
         {Drop{"a face", Quat::Identity()}, Drop{"another face", turned(90, Vec3::UnitY())},
          Drop{"an edge", turned(35, Vec3::UnitX())}, Drop{"a corner", turned(50, Vec3(1, 2, 0.5))},
          Drop{"another corner", turned(160, Vec3(-1, 0.3, 0.7))}}) {
      SCOPED_TRACE(drop.name + (impacts ? ", with impacts" : ", without impacts"));
      World<6> world = box_above_floor(impacts, k, drop.q);
      for (int n = 0; n < 600; ++n) world.step(h);
      expect_rest_on_a_face(world, k);
    }
}

TEST(Box, ThrownTumblingComesToRestOnAFace) {
  testing::Random random;
  for (int trial = 0; trial < 4; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const double k = 1e4;
    const Quat q = random.rotation();
    const Vec3 v = random.vector(3), omega = random.vector(8);
    World<6> world = box_above_floor(ImpactLaw{.friction = 0.5}, k, q, v, omega);
    const double first = kinetic_energy(world.bodies()) + m * g * world.x(1).z();
    for (int n = 0; n < 1200; ++n) {
      world.step(h);
      ASSERT_LT(kinetic_energy(world.bodies()) + m * g * world.x(1).z(), 2 * first) << "step " << n;
    }
    expect_rest_on_a_face(world, k);
  }
}

TEST(Box, FlatOnTheFloorHasTheGapOfAQuarterOfItsWeight) {
  // With the default k and d, the incomplete sharing of the load by Gauss-Seidel does not move the centre.
  World<6> world = box_above_floor({}, 1e6, Quat::Identity());
  for (int n = 0; n < 600; ++n) world.step(h);
  ASSERT_EQ(world.contacts().size(), 4U);
  double sum = 0;
  for (const Contact& contact : world.contacts()) sum += contact.gap;
  EXPECT_NEAR(sum, -m * g / 1e6, 1e-3 * m * g / 1e6);
  EXPECT_NEAR(world.x(1).z(), half.z() - m * g / 4e6, 1e-8);
  EXPECT_NEAR(support(world).z(), h * m * g, 1e-3 * h * m * g);
}

TEST(Box, TipsOverOnASlopeThatItsBaseIsTooShortFor) {
  // A tower of a × a × 3a tips where tan θ > 1/3, if it does not slide.
  for (const double slope : {0.30, 0.37}) {
    const double angle = std::atan(slope);
    World<6> world({.gravity = g * Vec3(std::sin(angle), 0, -std::cos(angle)), .k = 1e5, .friction = 1});
    world.add_plane(Vec3::UnitZ(), 0);
    const Vec3 tower(0.1, 0.1, 0.3);
    world.add({.x = Vec3(0, 0, 0.3), .principal = solid_box_moments(1, tower), .corners = box_corners(tower)});
    for (int n = 0; n < 120; ++n) world.step(h);
    const double upright = (orientation(world, 1) * Vec3::UnitZ()).z();
    if (slope < 1.0 / 3)
      EXPECT_GE(upright, 0.999);
    else
      EXPECT_LE(upright, 0.5);
  }
}

}  // namespace
}  // namespace spook::box_test
