#include <gtest/gtest.h>

#include "random_input.hpp"
#include "random_scenes.hpp"

namespace spook::testing {
namespace {

TEST(RandomScenes, FourHundredPassTheirChecks) {
  // In about one of a thousand the solver fails, and the run says so: several contacts on a loop of joints with motors.
  constexpr int most_unsolved = 2;
  int unsolved = 0;
  std::map<std::string, double> worst;
  for (std::uint64_t n = 0; n < 400; ++n) {
    const std::uint64_t seed = Random::seed() + n;
    Findings found = run_random_scene(seed);
    if (found.wrong.contains("unsolved") && ++unsolved <= most_unsolved) found.wrong.erase("unsolved");
    for (const auto& [what, text] : found.wrong)
      ADD_FAILURE() << what << ": " << text << "\n  random_scenes " << seed << " 1 runs it again";
    for (const auto& [what, share] : found.worst) worst[what] = std::max(worst[what], share);
  }
  // A check that never runs cannot fail: all must have run.
  for (const std::string what : {"solve", "momentum", "angular momentum", "energy"})
    EXPECT_GT(worst[what], 1e-6) << what << " was not checked";
}

TEST(RandomScenes, AreTheSameForTheSameSeed) {
  for (const std::uint64_t seed : {1, 2, 3, 4})
    EXPECT_EQ(run_random_scene(seed).worst, run_random_scene(seed).worst);
  EXPECT_NE(run_random_scene(1).worst, run_random_scene(2).worst);
}

}  // namespace
}  // namespace spook::testing
