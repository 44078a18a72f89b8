// Runs many random scenes: `random_scenes FIRST COUNT` runs those of COUNT seeds from FIRST. It prints each failure,
// and at the end the numbers of failures, of wrong runs that are called sound, and the largest values over their bounds.
// Exit code 1 if there is a failure.
#include <cstdio>
#include <cstdlib>

#include "random_scenes.hpp"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "random_scenes FIRST COUNT: the first seed, and the number of seeds\n");
    return 2;
  }
  const std::uint64_t first = std::strtoull(argv[1], nullptr, 10), count = std::strtoull(argv[2], nullptr, 10);
  std::map<std::string, std::uint64_t> times;
  std::uint64_t wrong = 0, unnoticed = 0;
  std::map<std::string, std::pair<double, std::uint64_t>> worst;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const spook::testing::Findings found = spook::testing::run_random_scene(seed);
    wrong += !found.wrong.empty();
    // The run check calls a run unsolved or lost; a diverged throws.
    unnoticed += !found.wrong.empty() && !found.wrong.contains("unsolved") && !found.wrong.contains("lost") &&
                 !found.wrong.contains("diverged");
    for (const auto& [what, text] : found.wrong) {
      ++times[what];
      std::printf("seed %llu, %s: %s\n", static_cast<unsigned long long>(seed), what.c_str(), text.c_str());
    }
    for (const auto& [what, share] : found.worst)
      if (!(share <= worst[what].first)) worst[what] = {share, seed};
  }
  std::printf("%llu scenes, %llu of them wrong, %llu wrong and called sound\n",
              static_cast<unsigned long long>(count), static_cast<unsigned long long>(wrong),
              static_cast<unsigned long long>(unnoticed));
  for (const auto& [what, n] : times)
    std::printf("%s: %llu\n", what.c_str(), static_cast<unsigned long long>(n));
  for (const auto& [what, most] : worst)
    std::printf("the largest value over its bound, %s: %g, seed %llu\n", what.c_str(), most.first,
                static_cast<unsigned long long>(most.second));
  return times.empty() ? 0 : 1;
}
