// The initial impulses of rows, and the order of their sweep.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/world/world.hpp"
#include "random_input.hpp"

namespace spook::warm_start_test {
namespace {

constexpr double h = 1.0 / 60, g = 9.81, radius = 0.5, k = 1e6;

/// Equal spheres at rest on each other.
World<3> stack(int bodies, Settings<3> settings) {
  settings.k = k;
  World<3> world(std::move(settings));
  world.add_plane(Vec3::UnitZ(), 0);
  double z = radius;
  for (int i = 0; i < bodies; ++i) {
    z -= (bodies - i) * g / k;  // gap = -N/k, Eq. (3.13)
    world.add({.x = Vec3(0, 0, z), .radius = radius});
    z += 2 * radius;
  }
  return world;
}

TEST(WarmStart, AStackAtRestIsSolvedBeforeTheFirstSweep) {
  const StopRule stop{.max_sweeps = 100'000, .tolerance = 1e-10};
  World<3> cold = stack(10, {.solver = gauss_seidel<3>(), .solver_limits = stop}),
           warm = stack(10, {.solver = gauss_seidel<3>(), .warm_start = true, .solver_limits = stop});
  for (int step = 0; step < 5; ++step) cold.step(h), warm.step(h);
  EXPECT_GT(cold.report().iterations, 500);
  EXPECT_LE(warm.report().iterations, 3);
  for (int contact = 0; contact < 10; ++contact)
    EXPECT_NEAR(warm.lambda(contact), h * (10 - contact) * g, 1e-8) << "contact " << contact;
}

TEST(WarmStart, IsTheSameMotionWhenSolvedToTheEnd) {
  const StopRule stop{.max_sweeps = 100'000, .tolerance = 1e-13};
  World<3> cold = stack(4, {.solver = gauss_seidel<3>(), .solver_limits = stop}),
           warm = stack(4, {.solver = gauss_seidel<3>(), .warm_start = true, .solver_limits = stop});
  for (World<3>* world : {&cold, &warm})
    world->add({.x = Vec3(0.1, 0, 6), .v = Vec3(0, 0, -2), .radius = radius});
  for (int step = 0; step < 60; ++step) {
    cold.step(h);
    warm.step(h);
    for (int body = 1; body <= 5; ++body)
      ASSERT_LE((cold.x(body) - warm.x(body)).norm(), 1e-9) << "step " << step << " body " << body;
  }
}

TEST(WarmStart, KeepsForcesWhenTheStepChanges) {
  const StopRule stop{.max_sweeps = 100'000, .tolerance = 1e-10};
  World<3> world = stack(10, {.warm_start = true, .solver_limits = stop});
  for (int step = 0; step < 3; ++step) world.step(h);
  world.step(h / 2);
  EXPECT_LE(world.report().iterations, 50) << "cold it takes hundreds";
  EXPECT_NEAR(world.lambda(0), h / 2 * 10 * g, 1e-8);
}

/// A row for each contact, with its number as λ.
std::vector<Row<3>> numbered_rows(std::size_t contacts) {
  std::vector<Row<3>> rows(contacts);
  for (std::size_t c = 0; c < contacts; ++c) rows[c].lambda = static_cast<double>(c + 1);
  return rows;
}

TEST(WarmStartCache, ReturnsTheImpulsesOfMatchedContacts) {
  testing::Random random;
  for (int round = 0; round < 2000; ++round) {
    // Up to five pairs with up to four contacts each. Then they creep, or jump, some change places, one is removed, or
    // added.
    std::vector<Contact> before;
    const int pairs = random.integer(1, 5);
    for (int pair = 0; pair < pairs; ++pair)
      for (int n = random.integer(1, 4); n > 0; --n)
        before.push_back(
            {.i = 0, .j = pair + 1, .n = Vec3::UnitZ(), .gap = 0, .r_i = Vec3::Zero(), .r_j = random.vector()});
    WarmStartCache start;
    start.remember<3>({.rows = numbered_rows(before.size())}, before, h);

    std::vector<Contact> now = before;
    const double size = random.log_uniform(1e-3, 2);
    for (Contact& contact : now) contact.r_j += random.vector(size);
    const int what = random.integer(0, 4);
    if (what == 1) std::reverse(now.begin(), now.end());
    if (what == 2 && now.size() > 1)
      now.erase(now.begin() + random.integer(0, static_cast<int>(now.size()) - 1));
    if (what == 3) now.front().i = 7;
    if (what == 4) {
      const auto beside = now.begin() + random.integer(0, static_cast<int>(now.size()) - 1);
      Contact more = *beside;
      more.r_j = random.vector();
      now.insert(beside, more);
    }

    std::vector<OldContact> old;
    for (const Contact& contact : before) old.push_back({contact.i, contact.j, contact.r_j});
    std::vector<double> wanted;
    for (const int match : match_contacts(now, old, infinity)) wanted.push_back(match + 1);
    EXPECT_EQ(start.impulses<3>({.rows = std::vector<Row<3>>(now.size())}, now, h), wanted)
        << "round " << round << ", size " << size;
  }
}

TEST(WarmStartCache, FollowTheirContactsAndForgetTheRest) {
  WarmStartCache start;
  EXPECT_TRUE(start.impulses<3>({.rows = std::vector<Row<3>>(5), .first_contact_row = 1}, {}, h).empty())
      << "nothing is kept yet";

  const auto contact = [](int i, int j, const Vec3& at) {
    return Contact{.i = i, .j = j, .n = Vec3::UnitZ(), .gap = 0, .r_i = Vec3::Zero(), .r_j = at};
  };
  // Rows of joints, then those of contacts: along z, x and y.
  const auto rows_with = [](int joints, const std::vector<double>& impulses) {
    ConstraintSet<3> all{.rows = std::vector<Row<3>>(impulses.size()),
                         .first_contact_row = static_cast<std::size_t>(joints),
                         .rows_per_contact = 3};
    for (int row = 0; row < std::ssize(all.rows); ++row) {
      all.rows[row].lambda = impulses[row];
      all.rows[row].Gj = Vec3::Unit((row - joints + 5) % 3);
    }
    return all;
  };
  // One row of a joint, then two contacts of one pair with three rows each.
  start.remember(rows_with(1, {9, 1, 2, 3, 4, 5, 6}),
                 {contact(0, 1, Vec3(1, 0, 0)), contact(0, 1, Vec3(-1, 0, 0))}, h);

  // One joint more; the contacts in the other order, one of them moved; and one of another pair.
  const std::vector<Contact> now = {contact(0, 1, Vec3(-1.1, 0, 0)), contact(0, 2, Vec3(1, 0, 0)),
                                    contact(0, 1, Vec3(1, 0, 0))};
  ConstraintSet<3> next = rows_with(2, std::vector<double>(11, 0));
  EXPECT_EQ(start.impulses(next, now, 2 * h), (std::vector<double>{18, 0, 8, 10, 12, 0, 0, 0, 2, 4, 6}))
      << "all twice, as h is";

  // A contact whose tangents have turned by a quarter keeps its friction as a vector, not its numbers.
  next.rows[3].Gj = Vec3::UnitY();
  next.rows[4].Gj = -Vec3::UnitX();
  EXPECT_EQ(start.impulses(next, now, 2 * h), (std::vector<double>{18, 0, 8, 12, -10, 0, 0, 0, 2, 4, 6}));

  // The first friction of a world gives contacts three rows; their impulses of before are those of one.
  ConstraintSet<3> smooth{.rows = rows_with(0, {1, 2}).rows};
  start.remember(smooth, {contact(0, 1, Vec3(1, 0, 0)), contact(0, 1, Vec3(-1, 0, 0))}, h);
  EXPECT_EQ(start.impulses(next, now, h), std::vector<double>(11, 0));
}

TEST(RowOrder, OneSweepShowsWhichWayItWent) {
  // Swept from the ground up, each sphere gets its own weight and the impulse below; from the top down the loads have
  // not arrived yet.
  const auto after_a_sweep = [](RowOrder order) {
    World<3> world = stack(3, {.solver = ordered_gauss_seidel<3>(order), .solver_limits = {.max_sweeps = 1}});
    world.step(h);
    return std::vector<double>{world.lambda(0), world.lambda(1), world.lambda(2)};
  };
  const std::vector<double> up = after_a_sweep(RowOrder::up), down = after_a_sweep(RowOrder::down);
  EXPECT_EQ(up, after_a_sweep(RowOrder::given)) << "a stack is listed from the ground up";
  EXPECT_GT(up[0], 0);
  EXPECT_NE(up, down);
  EXPECT_GT(down[0], up[0]) << "the impulses of the upper contacts act on the lowest at once";
}

TEST(RowOrder, RandomIsTheSameForTheSameSeed) {
  const auto run = [](std::uint64_t seed) {
    World<3> world = stack(
        6, {.solver = ordered_gauss_seidel<3>(RowOrder::random, seed), .solver_limits = {.max_sweeps = 3}});
    for (int step = 0; step < 5; ++step) world.step(h);
    return world.x(6).z();
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
}

TEST(RowOrder, InterleavedTakesTwoHalvesInTurn) {
  EXPECT_EQ(interleaved_order(0), std::vector<int>{});
  EXPECT_EQ(interleaved_order(1), std::vector<int>{0});
  EXPECT_EQ(interleaved_order(6), (std::vector<int>{0, 3, 1, 4, 2, 5}));
  EXPECT_EQ(interleaved_order(7), (std::vector<int>{0, 4, 1, 5, 2, 6, 3}));

  // In one sweep each sphere of a stack of four gets the impulses of those before it: the third only its own weight.
  const auto after_a_sweep = [](RowOrder order) {
    World<3> world = stack(4, {.solver = ordered_gauss_seidel<3>(order), .solver_limits = {.max_sweeps = 1}});
    world.step(h);
    return std::vector<double>{world.lambda(0), world.lambda(1), world.lambda(2), world.lambda(3)};
  };
  const std::vector<double> given = after_a_sweep(RowOrder::given),
                            interleaved = after_a_sweep(RowOrder::interleaved);
  EXPECT_EQ(given[0], interleaved[0]) << "the lowest comes first in both";
  EXPECT_LT(interleaved[2], given[2]) << "the second has not acted on the third yet";
}

TEST(RowOrder, AllSolveTheSame) {
  const StopRule stop{.max_sweeps = 100'000, .tolerance = 1e-13};
  for (const RowOrder order :
       {RowOrder::given, RowOrder::up, RowOrder::down, RowOrder::random, RowOrder::interleaved}) {
    World<3> world = stack(5, {.solver = ordered_gauss_seidel<3>(order), .solver_limits = stop});
    world.step(h);
    for (int contact = 0; contact < 5; ++contact)
      EXPECT_NEAR(world.lambda(contact), h * (5 - contact) * g, 1e-9);
  }
}

}  // namespace
}  // namespace spook::warm_start_test
