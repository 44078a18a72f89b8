// Impacts at one time: what lands flat stays flat, whatever the order of its contacts, and e = 1 keeps the energy.
#include "engine/impacts/simultaneous_impacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/impacts/impacts.hpp"
#include "engine/world/world.hpp"
#include "random_input.hpp"

namespace spook::simultaneous_impacts_test {
namespace {

constexpr double g = 9.81;

Settings<6> bouncing(double e, double mu = 0, double gravity = g) {
  return {
      .gravity = Vec3(0, 0, -gravity), .friction = mu, .impacts = ImpactLaw{.restitution = e, .friction = mu}};
}

/// The energy of body b that does not turn, with its velocity at the time of its position [J].
double energy_of(const World<6>& world, int b, double h) {
  const double mass = world.bodies().mass[world.index(b)];
  return mass * (world.synchronized_velocity(b, h).squaredNorm() / 2 + g * world.x(b).z());
}

struct Drop {
  double tilt = 0;                    ///< largest [rad]
  double aside = 0;                   ///< largest [m]
  double least = infinity, most = 0;  ///< energy in free flight over that of the start
};

/// Drops the last body of the world, which is at rest, for two seconds.
Drop drop(World<6> world, double h) {
  const int body = static_cast<int>(world.bodies().size()) - 1;
  world.start_half_step_back(h);
  const Quat q = orientation(world, body);
  const Vec3 x = world.x(body);
  const double E = energy_of(world, body, h);
  Drop drop;
  int impacts = 0;
  for (int n = 0; n < 2 / h; ++n) {
    world.step(h);
    impacts += world.report().impacts;
    drop.tilt = std::max(drop.tilt, 2 * (orientation(world, body) * q.conjugate()).vec().norm());
    drop.aside = std::max(drop.aside, (world.x(body) - x).head<2>().norm());
    const auto touches = [&](const Contact& contact) { return contact.i == body || contact.j == body; };
    if (std::any_of(world.contacts().begin(), world.contacts().end(), touches)) continue;
    drop.least = std::min(drop.least, energy_of(world, body, h) / E);
    drop.most = std::max(drop.most, energy_of(world, body, h) / E);
  }
  EXPECT_GE(impacts, 2);
  return drop;
}

const double steps[] = {1.0 / 30, 1.0 / 60, 1.0 / 240, 1.0 / 1000};

/// A velocity of one impact is right to 1e-12, Σ over S_kk, so a tilt after a few flights of some seconds is below
/// 1e-9, and an energy, too.
void expect_flat(const Drop& drop, const std::string& what, double h) {
  EXPECT_LE(drop.tilt, 1e-9) << what << ", h " << h;
  EXPECT_LE(drop.aside, 1e-9) << what << ", h " << h;
  EXPECT_NEAR(drop.least, 1, 1e-9) << what << ", h " << h;
  EXPECT_NEAR(drop.most, 1, 1e-9) << what << ", h " << h;
}

TEST(SimultaneousImpacts, WhatLandsFlatStaysFlatAndKeepsItsEnergy) {
  for (const double h : steps)
    for (const double mu : {0.0, 0.5}) {
      for (const Vec3& half : {Vec3(0.3, 0.2, 0.1), Vec3(1, 0.7, 0.02)}) {
        World<6> on_floor(bouncing(1, mu));
        on_floor.add_plane(Vec3::UnitZ(), 0);
        on_floor.add({.x = Vec3(0, 0, 1), .mass = 2, .half_sides = half});
        expect_flat(drop(on_floor, h), "a box on the floor", h);
      }
      World<6> on_smaller(bouncing(1, mu));
      on_smaller.add_fixed_box(Vec3(0, 0, 0.25), Vec3(0.2, 0.2, 0.25));
      on_smaller.add({.x = Vec3(0, 0, 2), .mass = 1, .half_sides = Vec3(0.5, 0.5, 0.5)});
      expect_flat(drop(on_smaller, h), "a box on a smaller one", h);

      World<6> on_two(bouncing(1, mu));
      for (const double x : {-1.0, 1.0}) on_two.add_fixed_box(Vec3(x, 0, 0.25), Vec3(0.2, 0.2, 0.25));
      on_two.add({.x = Vec3(0, 0, 1.5), .mass = 1, .half_sides = Vec3(1.5, 0.2, 0.1)});
      expect_flat(drop(on_two, h), "a plank on two boxes", h);

      World<6> capsule(bouncing(1, mu));
      capsule.add_plane(Vec3::UnitZ(), 0);
      capsule.add({.x = Vec3(0, 0, 1),
                   .mass = 1,
                   .radius = 0.2,
                   .q = Quat(std::sqrt(0.5), std::sqrt(0.5), 0, 0),
                   .half_length = 0.7});
      expect_flat(drop(capsule, h), "a capsule", h);
    }
}

TEST(SimultaneousImpacts, ABoxBouncesOnABoxThatRests) {
  // The impact goes on through the lower box to the floor and back, whole sides at a time.
  for (const double h : steps) {
    World<6> world(bouncing(1));
    world.add_plane(Vec3::UnitZ(), 0);
    world.add({.x = Vec3(0, 0, 0.2), .mass = 1, .half_sides = Vec3(0.2, 0.2, 0.2)});
    world.add({.x = Vec3(0, 0, 1.5), .mass = 1, .half_sides = Vec3(0.5, 0.5, 0.5)});
    const Drop fall = drop(world, h);
    EXPECT_LE(fall.tilt, 1e-9) << h;
    EXPECT_LE(fall.aside, 1e-9) << h;
  }
}

TEST(SimultaneousImpacts, ABallThatHitsTwoAtOnceLeavesStraight) {
  // Along the line of symmetry momentum and energy, v = w + 2 c u and v² = w² + 2 u² with c = cos 30°, have the one
  // solution u = 2 c v/(1 + 2 c²) and w = (1 - 2 c²)/(1 + 2 c²) v = -v/5.
  const double v = 2, c = std::sqrt(0.75), radius = 0.2;
  for (const double h : steps) {
    World<6> world(bouncing(1, 0, 0));
    world.add({.x = Vec3(-1, 0, 0), .v = Vec3(v, 0, 0), .mass = 1, .radius = radius});
    for (const double side : {-1.0, 1.0})
      world.add({.x = 2 * radius * Vec3(c, side / 2, 0), .mass = 1, .radius = radius});
    for (int n = 0; n < 1.5 / h; ++n) world.step(h);
    EXPECT_NEAR(world.v(0).x(), -v / 5, 1e-9) << h;
    EXPECT_NEAR(world.v(0).y(), 0, 1e-9) << h;
    for (const int b : {1, 2}) EXPECT_NEAR(world.v(b).norm(), 2 * c * v / (1 + 2 * c * c), 1e-9) << h;
  }
}

TEST(SimultaneousImpacts, RandomContactsHaveTheirRestitutionAndGainNoEnergy) {
  constexpr unsigned seed = 71;
  testing::Random random(seed);
  int tried = 0;
  for (int trial = 0; trial < 400; ++trial) {
    // A body on a fixed one, and a third body above. Normals are anything upwards.
    Motion<6> motion;
    motion.inverse_mass = {
        {0, Mat3::Zero()}, {1, Vec3(2, 3, 4).asDiagonal()}, {0.5, Vec3(1, 5, 2).asDiagonal()}};
    motion.W.assign(3, Twist<6>::Zero());
    motion.Wf.assign(3, Twist<6>::Zero());
    for (const int b : {1, 2}) {
      motion.W[b].head<3>() = random.vector();
      motion.W[b].tail<3>() = random.vector();
      motion.Wf[b].head<3>() = 0.1 * random.vector();
    }
    std::vector<Contact> contacts;
    std::vector<ImpactLaw> laws;
    std::vector<double> before;
    const double e = trial % 4 < 2 ? 1 : random.uniform(0, 1);
    const double mu = trial % 2 == 0 ? 0 : random.uniform(0, 1);
    // Hardly any contact approaches where the bodies separate fast. Then the next trial draws other velocities.
    for (int draw = 0; draw < 100 && contacts.size() < 4; ++draw) {
      const int i = contacts.size() % 2 == 0 ? 0 : 1;
      const Vec3 r_i = random.vector(), r_j = random.vector(),
                 n = (Vec3::UnitZ() + 0.5 * random.vector()).normalized();
      const Contact contact{.i = i, .j = i + 1, .n = n, .gap = 0, .r_i = r_i, .r_j = r_j};
      if (!(separation_speed(contact, motion) < -1e-3)) continue;
      contacts.push_back(contact);
      laws.push_back({.restitution = e, .friction = mu});
      before.push_back(separation_speed(contact, motion));
    }
    if (contacts.size() < 4) continue;
    ++tried;
    const auto energy = [&] {
      double sum = 0;
      for (const int b : {1, 2}) {
        const Twist<6> W = motion.W[b] + motion.Wf[b] / 2;
        const InverseMass<6>& inverse = motion.inverse_mass[b];
        sum += W.head<3>().squaredNorm() / inverse.linear / 2;
        sum += W.tail<3>().dot(inverse.angular.inverse() * W.tail<3>()) / 2;
      }
      return sum;
    };
    const double E = energy();
    resolve_together<6>(contacts, laws, {}, motion);
    EXPECT_LE(energy(), E * (1 + 1e-9)) << "trial " << trial << ", seed " << seed;
    if (e == 1 && mu == 0) {
      EXPECT_NEAR(energy(), E, 1e-9 * E) << "trial " << trial << ", seed " << seed;
    }
    // Sweeps on cones end at 1e-12 of the fastest approach, or do not converge: then the restitution is not exact.
    for (std::size_t c = 0; mu == 0 && c < contacts.size(); ++c)
      EXPECT_GE(separation_speed(contacts[c], motion), -e * before[c] - 1e-9)
          << "trial " << trial << ", seed " << seed;
  }
  EXPECT_GE(tried, 250);
}

}  // namespace
}  // namespace spook::simultaneous_impacts_test
