// Excluded contacts: bodies of one list do not touch each other, but touch all others.
#include <gtest/gtest.h>

#include "engine/world/world.hpp"
#include "refusals.hpp"

namespace spook::exclusions_test {
namespace {

/// Body 0 is a plane; bodies 1 to 4 are a ball, a box, a capsule and a static ball at one place, which touch it.
World<6> heap() {
  World<6> world({});
  world.add_plane(Vec3::UnitZ(), 0);
  const Vec3 x(0, 0, 0.05);
  world.add({.x = x, .mass = 1, .radius = 0.1});
  world.add({.x = x, .mass = 1, .half_sides = Vec3::Constant(0.1)});
  world.add({.x = x, .mass = 1, .radius = 0.1, .half_length = 0.2});
  world.add_fixed(x, 0.1);
  return world;
}

using Pairs = std::vector<Pair>;

/// Returns the pairs of bodies that touch in the next step.
Pairs touching(World<6> world) {
  world.step(1e-6);
  Pairs pairs;
  for (const Contact& contact : world.contacts()) pairs.push_back(std::minmax(contact.i, contact.j));
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

const Pairs all_but_static = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {1, 4}, {2, 3}, {2, 4}, {3, 4}};

Pairs without(const Pairs& pairs, const Pairs& excluded) {
  Pairs left;
  for (const Pair& pair : pairs)
    if (std::find(excluded.begin(), excluded.end(), pair) == excluded.end()) left.push_back(pair);
  return left;
}

TEST(Exclusions, BodiesOfAListDoNotTouchAndTouchAllOthers) {
  EXPECT_EQ(touching(heap()), all_but_static);
  World<6> pair = heap();
  pair.exclude_contacts({2, 1});
  EXPECT_EQ(touching(pair), without(all_but_static, {{1, 2}}));
  World<6> list = heap();
  list.exclude_contacts({0, 2, 3});
  EXPECT_EQ(touching(list), without(all_but_static, {{0, 2}, {0, 3}, {2, 3}}));
}

TEST(Exclusions, ABodyMayBeInSeveralLists) {
  // Neighbours of a chain: 1 and 3 have no list in common.
  World<6> world = heap();
  world.exclude_contacts({1, 2});
  world.exclude_contacts({2, 3});
  world.exclude_contacts({3, 4});
  EXPECT_EQ(touching(world), without(all_but_static, {{1, 2}, {2, 3}, {3, 4}}));
}

TEST(Exclusions, CornersPassAnExcludedPlane) {
  for (const bool excluded : {false, true}) {
    World<6> world({});
    world.add_plane(Vec3::UnitZ(), 0);
    world.add({.x = Vec3(0, 0, 0.1),
               .mass = 1,
               .principal = Vec3::Ones(),
               .corners = {Vec3(0.1, 0, -0.1), Vec3(-0.1, 0, -0.1), Vec3(0, 0.1, -0.1)}});
    if (excluded) world.exclude_contacts({0, 1});
    world.step(1.0 / 60);
    EXPECT_EQ(world.contacts().size(), excluded ? 0u : 3u);
  }
}

TEST(Exclusions, FollowTheirBodiesWhenOthersAreRemoved) {
  World<6> world = heap();
  world.exclude_contacts({1, 2});
  world.exclude_contacts({3, 4});
  world.remove_body(1);  // the bodies 2, 3, 4 are 1, 2, 3 now, and the last two are a list
  EXPECT_EQ(touching(world), (Pairs{{0, 1}, {0, 2}, {1, 2}, {1, 3}}));
  world.remove_body(3);
  world.add({.x = Vec3(0, 0, 0.05), .mass = 1, .radius = 0.1});  // removes the index, and not the list
  EXPECT_EQ(touching(world), (Pairs{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}));
}

TEST(Exclusions, CountNoRowAndNoImpact) {
  World<6> world({.impacts = ImpactLaw{.restitution = 1}});
  world.add({.x = Vec3(-0.2, 0, 0), .v = Vec3(3, 0, 0), .mass = 1, .radius = 0.1});
  world.add({.x = Vec3(0.2, 0, 0), .v = Vec3(-3, 0, 0), .mass = 1, .radius = 0.1});
  world.exclude_contacts({0, 1});
  for (int n = 0; n < 20; ++n) {
    world.step(1.0 / 60);
    EXPECT_EQ(world.report().impacts + world.report().contacts + world.report().rows, 0);
  }
  EXPECT_EQ(world.v(0).x(), 3);
  EXPECT_EQ(world.v(1).x(), -3);
}

TEST(Exclusions, ThreadsFindTheSame) {
  const auto found = [](int threads) {
    World<6> world({.threads = threads});
    world.add_plane(Vec3::UnitZ(), 0);
    for (int n = 0; n < 600; ++n)
      world.add(
          {.x = Vec3(0.15 * (n % 10), 0.15 * (n / 10 % 10), 0.1 + 0.15 * (n / 100)), .mass = 1, .radius = 0.1});
    std::vector<int> even;
    for (int n = 1; n <= 600; n += 2) even.push_back(n);
    world.exclude_contacts(even);
    world.step(1e-3);
    int of_even = 0;
    for (const Contact& contact : world.contacts()) of_even += contact.i % 2 == 1 && contact.j % 2 == 1;
    EXPECT_EQ(of_even, 0);
    return world.contacts().size();
  };
  EXPECT_EQ(found(1), found(2));
  EXPECT_GT(found(1), 600u);
}

TEST(Exclusions, BodiesOnAJointTouchUnlessTheyAreExcluded) {
  for (const bool excluded : {false, true}) {
    World<6> world = heap();
    world.add_joint({.i = 1, .j = 2});
    if (excluded) world.exclude_contacts({1, 2});
    EXPECT_EQ(touching(world), excluded ? without(all_but_static, {{1, 2}}) : all_but_static);
  }
}

TEST(Exclusions, RefuseWhatIsNoList) {
  World<6> world = heap();
  expect_refusal({"body", "9"}, [&] { world.exclude_contacts({1, 9}); });
  expect_refusal({"body", "once", "2"}, [&] { world.exclude_contacts({1, 2, 2}); });
  expect_refusal({"bodies", "1"}, [&] { world.exclude_contacts({1}); });
  expect_refusal({"bodies", "0"}, [&] { world.exclude_contacts({}); });
  EXPECT_EQ(touching(world), all_but_static);
}

}  // namespace
}  // namespace spook::exclusions_test
