// Steps that return their outcome, and pairs that begin and end to touch.
#include <gtest/gtest.h>

#include "engine/diagnostics/contact_events.hpp"
#include "engine/world/try_step.hpp"

namespace spook::events_test {

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

}  // namespace spook::events_test
