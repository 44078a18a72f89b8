// Threads: contacts, rows and solutions do not depend on their number, and sweeps in stripes solve as sweeps do.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>

#include "10_convergence/convergence.hpp"
#include "engine/support/parallel_for.hpp"
#include "engine/world/world.hpp"
#include "random_input.hpp"
#include "refusals.hpp"
#include "velocities.hpp"

namespace spook::threads_test {
namespace {

constexpr double h = 1.0 / 120, side = 0.2, k = 1e4;

/// Balls and boxes in a heap over a floor and between walls, in an order unrelated to their places. Some are tied to
/// others, far away.
World<6> heap(const Solver<6>& solver, int threads, bool tied = true, int high = 12,
              const StopRule& stop = {.max_sweeps = 5}, const std::optional<SoftSteps>& soft = {}) {
  testing::Random random;  // the same in each call
  World<6> world({.k = soft ? std::nullopt : std::optional(k),
                  .friction = 0.4,
                  .solver = solver,
                  .warm_start = true,
                  .soft_steps = soft,
                  .threads = threads,
                  .solver_limits = stop});
  world.add_plane(Vec3::UnitZ(), 0);
  world.add_plane(Vec3::UnitX(), -0.01);
  constexpr int across = 7;
  std::vector<Vec3> places;
  for (int z = 0; z < high; ++z)
    for (int y = 0; y < across; ++y)
      for (int x = 0; x < across; ++x) places.push_back(0.97 * side * Vec3(x + 0.5, y + 0.5, z + 0.5));
  for (std::size_t b = places.size() - 1; b > 0; --b)
    std::swap(places[b], places[static_cast<std::size_t>(random.integer(0, static_cast<int>(b)))]);
  for (std::size_t b = 0; b < places.size(); ++b) {
    Body<6> body{
        .x = places[b] + random.vector(0.005), .v = random.vector(0.1), .mass = random.uniform(0.5, 2)};
    if (b % 2 == 0)
      body.radius = side / 2, body.principal = Vec3::Constant(0.4 * body.mass * body.radius * body.radius);
    else
      body.half_sides = Vec3::Constant(side / 2), body.principal = Vec3::Constant(body.mass * side * side / 6);
    world.add(body);
  }
  if (tied)
    for (int body = 2; body + 1 < static_cast<int>(world.bodies().size()); body += 4)
      world.add_joint({.i = body, .j = body + 1, .length = (world.x(body) - world.x(body + 1)).norm()});
  return world;
}

void expect_same_bits(const World<6>& one, const World<6>& other, const std::string& what) {
  ASSERT_EQ(one.rows().size(), other.rows().size()) << what;
  for (std::size_t row = 0; row < one.rows().size(); ++row) {
    ASSERT_EQ(one.rows()[row].lambda, other.rows()[row].lambda) << what << ", row " << row;
    ASSERT_EQ(one.rows()[row].i, other.rows()[row].i) << what << ", row " << row;
    ASSERT_EQ(one.rows()[row].j, other.rows()[row].j) << what << ", row " << row;
  }
  for (std::size_t b = 0; b < one.bodies().size(); ++b) {
    ASSERT_EQ(one.bodies().x[b], other.bodies().x[b]) << what << ", body " << b;
    ASSERT_EQ(one.bodies().motion.W[b], other.bodies().motion.W[b]) << what << ", body " << b;
  }
  EXPECT_EQ(one.solved().history, other.solved().history) << what;
}

/// Compares the worlds that `make` returns for 1, 2, 3 and 8 threads, over twelve steps.
template <class Make>
void expect_same_bits_on_any_threads(const Make& make, const std::string& what) {
  World<6> one = make(1);
  std::vector<World<6>> others;
  for (const int threads : {2, 3, 8}) others.push_back(make(threads));
  for (int n = 0; n < 12; ++n) {
    one.step(h);
    ASSERT_GT(one.rows().size(), 3000U) << "too few for three threads";
    for (World<6>& other : others) {
      other.step(h);
      expect_same_bits(
          one, other,
          what + " on " + std::to_string(other.settings().threads) + " threads, step " + std::to_string(n));
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(Threads, ChangeNoBitWhateverTheirNumberAndTheSolver) {
  for (const char* name : {"spatial_decomposition", "gauss_seidel"}) {
    const Solver<6> solver = find_solver<6>(name).make_on_box();
    expect_same_bits_on_any_threads([&](int threads) { return heap(solver, threads); }, name);
  }
}

TEST(Threads, ChangeNoBitOfSoftSteps) {
  const auto soft = [](int threads) { return heap(gauss_seidel<6>(), threads, true, 24, {}, SoftSteps{}); };
  World<6> one = soft(1);
  one.step(h);
  ASSERT_GT(one.contacts().size(), 3000U) << "contacts, too, must be enough for three threads";
  expect_same_bits_on_any_threads(soft, "soft steps");
}

TEST(Threads, HelpOneCallInsideAnother) {
  std::atomic<int> calls = 0;
  const auto once = [] { return false; };
  for (int repeat = 0; repeat < 3; ++repeat)
    in_rounds(
        3,
        [&](int) {
          in_rounds(
              2, [&](int) { ++calls; }, once);
        },
        once);
  EXPECT_EQ(calls, 3 * 3 * 2);
}

TEST(Threads, HelpAProcessThatForks) {
  std::atomic<int> calls = 0;
  const auto count = [&] {
    in_rounds(
        4, [&](int) { ++calls; }, [] { return false; });
  };
  count();
  const pid_t child = fork();
  if (child == 0) {
    count();
    _exit(calls == 8 ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "of the child: " << status;
  count();
  EXPECT_EQ(calls, 8);
}

TEST(Stripes, SolveWhatSweepsDo) {
  // Σ > 0 makes the solution of a box of friction unique. Both stop where a sweep changes 1e-7 m/s or less.
  const StopRule sharp{.max_sweeps = 100'000, .tolerance = 1e-7};
  for (const bool tied : {false, true}) {
    World<6> swept = heap(gauss_seidel<6>(), 1, tied, 5, sharp),
             striped = heap(spatial_decomposition<6>(), 2, tied, 5, sharp);
    swept.step(h);
    striped.step(h);
    EXPECT_TRUE(striped.solved().converged);
    // Less than a hundred rows, those of its two bodies, may have changed a row's residual since its last update.
    EXPECT_LE(striped.report().residual, 100 * 1e-7) << "of every row, in any stripe";
    // The remaining error at a rate ρ is r ρ/(1 - ρ), (10.5): with as many sweeps as it took, 1e-7 of them at the most.
    const double bound = 1e-7 * static_cast<double>(swept.solved().history.size());
    EXPECT_LE(apart(swept, striped), bound);
  }
}

TEST(Stripes, UpdateEveryRowOnceASweep) {
  World<6> world = heap(spatial_decomposition<6>(), 2);
  world.step(h);
  EXPECT_EQ(world.solved().history.size(), 5U);
  EXPECT_EQ(world.row_updates(), 5 * std::ssize(world.rows()));
}

TEST(Stripes, KeepTheOrderOfTheRows) {
  World<6> swept = heap(gauss_seidel<6>(), 1), striped = heap(spatial_decomposition<6>(), 2);
  swept.step(h);
  striped.step(h);
  ASSERT_EQ(swept.rows().size(), striped.rows().size());
  for (std::size_t row = 0; row < swept.rows().size(); ++row) {
    EXPECT_EQ(swept.rows()[row].i, striped.rows()[row].i) << "row " << row;
    EXPECT_EQ(swept.rows()[row].j, striped.rows()[row].j) << "row " << row;
  }
}

TEST(Stripes, TakeWhatHasFewBodiesOrNoExtent) {
  World<3> one({.solver = spatial_decomposition<3>(), .threads = 4});
  one.add_plane(Vec3::UnitZ(), 0);
  one.add({.x = Vec3(0, 0, 0.1), .radius = 0.1});
  for (int n = 0; n < 60; ++n) one.step(h);
  EXPECT_NEAR(one.x(1).z(), 0.1, 1e-4) << "one body, at rest";
  World<3> same({.gravity = Vec3::Zero(), .solver = spatial_decomposition<3>(), .threads = 4});
  for (int body = 0; body < 3; ++body) same.add({.x = Vec3::Zero()});
  same.add_joint({.i = 0, .j = 1});
  same.step(h);
  EXPECT_EQ(same.x(1), Vec3::Zero()) << "bodies at one place";
}

TEST(Shares, CoverAllItemsInOrderAndPassExceptionsOn) {
  for (const std::size_t n : {std::size_t{0}, std::size_t{999}, std::size_t{2000}, std::size_t{10'007}})
    for (const int threads : {1, 2, 7}) {
      const std::size_t shares = shares_of(threads, n);
      std::vector<std::pair<std::size_t, std::size_t>> of(shares);
      parallel_for(threads, n, [&](std::size_t share, std::size_t first, std::size_t end) {
        of[share] = {first, end};
      });
      std::size_t next = 0;
      for (const auto& [first, end] : of) {
        EXPECT_EQ(first, next);
        EXPECT_TRUE(shares == 1 || end - first >= 1000) << "too few for a thread";
        next = end;
      }
      EXPECT_EQ(next, n);
    }
  EXPECT_THROW(parallel_for(4, 10'000,
                            [](std::size_t, std::size_t first, std::size_t) {
                              if (first > 0) throw std::runtime_error("one of them");
                            }),
               std::runtime_error);
}

TEST(Threads, AreRefusedByNameAndNumber) {
  for (const int bad : {-1, 0, 257})
    expect_refusal({"threads", std::to_string(bad)}, [bad] { World<3> world({.threads = bad}); });
}

}  // namespace
}  // namespace spook::threads_test
