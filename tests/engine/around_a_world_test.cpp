// Functions for programs around a world: steps that return their outcome, begins and ends of touching, handles.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/diagnostics/contact_events.hpp"
#include "engine/world/handles.hpp"
#include "engine/world/try_step.hpp"
#include "refusals.hpp"

namespace spook::around_a_world_test {

using Pairs = std::vector<TouchingPair>;

TEST(TryStep, IsAStep) {
  World<3> one({}), other({});
  for (World<3>* world : {&one, &other}) world->add({.v = Vec3(1, 2, 3)});
  one.step(0.25);
  EXPECT_FALSE(try_step(other, 0.25).has_value());
  EXPECT_EQ(one.x(0), other.x(0));
  EXPECT_THROW((void)try_step(one, -1.0), std::invalid_argument);
}

TEST(TryStep, ReturnsWhatStepThrows) {
  World<3> world({});
  const int body = world.add({.v = Vec3(1e308, 0, 0)});
  const std::optional<SimulationDiverged> diverged = try_step(world, 1e10);
  ASSERT_TRUE(diverged.has_value());
  EXPECT_EQ(diverged->step(), 1);
  EXPECT_EQ(diverged->body(), body);
}

TEST(TryStep, ReturnsWhatIsWrongUntilTheWorldIsMended) {
  bool broken = true;
  World<6> world({.force = [&](std::size_t i, const std::vector<Vec3>&) {
    return Vec3(broken && i > 0 ? std::nan("") : 0, 0, 0);
  }});
  world.add_plane(Vec3::UnitZ(), 0);
  for (int i = 1; i <= 2; ++i) world.add({.x = Vec3(i, 0, 1), .mass = 1, .radius = 0.1});
  for (int n = 0; n < 3; ++n) {
    const std::optional<SimulationDiverged> diverged = try_step(world, 1.0 / 60);
    ASSERT_TRUE(diverged.has_value()) << n;
    EXPECT_EQ(diverged->body(), 1);
  }
  broken = false;
  for (int i = 1; i <= 2; ++i) {
    world.place(i, Vec3(i, 0, 1), Vec3::Zero());
    world.turn(i, Quat::Identity(), Vec3::Zero());
  }
  EXPECT_FALSE(try_step(world, 1.0 / 60).has_value());
}

TEST(ContactEvents, ABallThatFallsAndIsLiftedTouchesOnce) {
  World<6> world({});
  const int floor = world.add_plane(Vec3::UnitZ(), 0);
  const int ball = world.add({.x = Vec3(0, 0, 0.6), .mass = 1, .radius = 0.5});
  ContactEvents events;
  int begun = 0, ended = 0;
  const auto step = [&] {
    world.step(1.0 / 240);
    events.look(world);
    begun += static_cast<int>(events.begun().size());
    ended += static_cast<int>(events.ended().size());
  };
  for (int n = 0; n < 240; ++n) step();  // it falls 0.1 m in 0.14 s
  EXPECT_EQ(begun - ended, 1) << "it rests on the floor";
  EXPECT_EQ(events.touching(), Pairs({std::minmax(floor, ball)}));
  const int before = ended;
  world.place(ball, Vec3(0, 0, 2), Vec3::Zero());
  step();
  EXPECT_EQ(events.ended(), Pairs({std::minmax(floor, ball)}));
  EXPECT_EQ(ended, before + 1);
  EXPECT_TRUE(events.touching().empty());
  step();
  EXPECT_TRUE(events.begun().empty() && events.ended().empty());
}

TEST(ContactEvents, ABounceBeginsAndEnds) {
  for (const bool soft : {false, true}) {
    SCOPED_TRACE(soft ? "soft steps" : "rigid steps");
    Settings<6> settings{.impacts = ImpactLaw{.restitution = 0.8}};
    if (soft) settings.soft_steps = SoftSteps{};
    World<6> world(settings);
    const int floor = world.add_plane(Vec3::UnitZ(), 0);
    const int ball = world.add({.x = Vec3(0, 0, 1), .mass = 1, .radius = 0.1});
    ContactEvents events;
    int bounces = 0, begun = 0, ended = 0;
    for (int n = 0; n < 120; ++n) {  // it falls 0.9 m in 0.43 s, and again after another 0.69 s
      world.step(1.0 / 60);
      events.look(world);
      for (const Impact& impact : world.impacts()) {
        EXPECT_EQ(std::minmax(impact.i, impact.j), std::minmax(floor, ball));
        const double fallen = std::sqrt(2 * 9.81 * 0.9) * std::pow(0.8, bounces);
        EXPECT_NEAR(impact.speed, fallen, 0.1 * fallen);
        EXPECT_EQ(events.begun(), Pairs({std::minmax(floor, ball)}));
        ++bounces;
      }
      EXPECT_EQ(world.report().impacts, std::ssize(world.impacts()));
      begun += static_cast<int>(events.begun().size());
      ended += static_cast<int>(events.ended().size());
    }
    EXPECT_GE(bounces, 2);
    EXPECT_EQ(begun, bounces);
    EXPECT_EQ(ended, bounces);
    world.remove_body(ball);
    EXPECT_TRUE(world.impacts().empty()) << "its bodies have other indices now";
  }
}

TEST(ContactEvents, APairIsNamedOnceHoweverManyContactsItHas) {
  World<6> world({.friction = 0.5});
  const int floor = world.add_plane(Vec3::UnitZ(), 0);
  const int box = world.add({.x = Vec3(0, 0, 0.1), .mass = 1, .half_sides = Vec3(0.1, 0.1, 0.1)});
  ContactEvents events;
  for (int n = 0; n < 2; ++n) {
    world.step(1.0 / 60);
    events.look(world);
  }
  EXPECT_GT(world.contacts().size(), 1U);
  EXPECT_EQ(events.touching(), Pairs({std::minmax(floor, box)}));
  events.forget();
  EXPECT_TRUE(events.touching().empty());
}

/// Bodies and joints are identified by numbers that they keep: masses and lengths.
TEST(Handles, NameTheSameWhateverIsRemoved) {
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const auto one_of = [&](const auto& some) {
    return some[std::uniform_int_distribution<std::size_t>(0, some.size() - 1)(random)];
  };
  World<3> world({});
  Handles<3> handles(world);
  std::vector<int> bodies, joints;
  std::vector<double> mass, length;  // by handle
  double next = 0;
  for (int n = 0; n < 400; ++n) {
    const int action = std::uniform_int_distribution<int>(0, 5)(random);
    if (action < 2 || bodies.size() < 2) {
      bodies.push_back(handles.of_body(world.add({.x = Vec3(next, 0, 0), .mass = ++next})));
      ASSERT_EQ(bodies.back(), static_cast<int>(mass.size())) << "handles are numbers from 0 on";
      mass.push_back(next);
    } else if (action < 4) {
      const int i = handles.body(bodies.front()), j = handles.body(bodies.back());
      joints.push_back(handles.of_joint(world.add_joint({.i = i, .j = j, .length = ++next})));
      length.push_back(next);
    } else if (action == 4 || joints.empty()) {
      const int body = one_of(bodies), index = handles.body(body);
      std::erase_if(joints, [&](int joint) {
        const Joint& each = world.joints()[static_cast<std::size_t>(handles.joint(joint))];
        return each.i == index || each.j == index;
      });
      std::erase(bodies, body);
      handles.remove_body(body);
      EXPECT_THROW((void)handles.body(body), std::invalid_argument);
    } else {
      const int joint = one_of(joints);
      std::erase(joints, joint);
      handles.remove_joint(joint);
      EXPECT_THROW(handles.remove_joint(joint), std::invalid_argument);
    }
    ASSERT_EQ(world.bodies().size(), bodies.size());
    ASSERT_EQ(world.joints().size(), joints.size());
    for (const int body : bodies)
      ASSERT_EQ(world.bodies().mass[static_cast<std::size_t>(handles.body(body))],
                mass[static_cast<std::size_t>(body)]);
    for (const int joint : joints)
      ASSERT_EQ(world.joints()[static_cast<std::size_t>(handles.joint(joint))].length,
                length[static_cast<std::size_t>(joint)]);
  }
}

TEST(Handles, RefuseUnknownBodiesAndJoints) {
  World<3> world({});
  Handles<3> handles(world);
  EXPECT_THROW((void)handles.of_body(0), std::invalid_argument);
  EXPECT_THROW((void)handles.of_joint(0), std::invalid_argument);
  EXPECT_THROW((void)handles.body(0), std::invalid_argument);
  EXPECT_THROW((void)handles.joint(-1), std::invalid_argument);
  const int body = handles.of_body(world.add({}));
  handles.remove_body(body);
  expect_refusal({"handle of a body", "is 0", "was removed"}, [&] { (void)handles.body(body); });
  expect_refusal({"handle of a joint", "is 3", "of_joint never returned"}, [&] { (void)handles.joint(3); });
}

}  // namespace spook::around_a_world_test
