// The rate at which the entries of a history decrease.
#include "exercise_test.hpp"
#include "relative_scales.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(ObservedRate, "10.6 observed_rate");

std::vector<double> falling(double first, double rate, int n) {
  std::vector<double> history;
  for (int k = 0; k < n; ++k) history.push_back(first * std::pow(rate, k));
  return history;
}

EXERCISE_TEST(ObservedRate, OfAGeometricHistoryIsItsFactor) {
  Random random;
  for (const int n : {2, 3, 4, 7, 20, 101}) {
    const double rate = random.uniform(0.7, 1.05);
    const int m = (n + 1) / 2;
    const auto history = falling(0.3, rate, n);
    expect_near(
        "rate of " + std::to_string(n) + " entries that shrink by " + show(rate), "Eq. (10.5)",
        observed_rate(history), rate, {1e-13, "powers up to 50"},
        {{1 / rate, "This is e_m/e_n. Divide by the earlier: the later one is on top."},
         {std::pow(rate, n - m), "This is the whole drop. The factor of one sweep is its (n-m)-th root."},
         {std::log(rate), "This is the logarithm of the rate."},
         {std::pow(rate, double(n - m) / (n - m + 1)),
          "From entry m to entry n there are n - m sweeps, not one more."},
         {std::pow(rate, double(n - m) / n), "The root is that of the n - m sweeps between the two entries."},
         {std::pow(rate, 2.0 * (n - m) / n), "Take the root of order n - m, which is n/2 for even n only."},
         {1 - rate, "This is the fraction that a sweep removes. The rate is the fraction that remains."}},
        "(e_n/e_m)^(1/(n - m)), with m = ⌈n/2⌉.");
  }
}

EXERCISE_TEST(ObservedRate, DropsNothingSmall) {
  for (const double part : relative_scales)
    expect_near("rate of entries that shrink by " + show(part), "Eq. (10.5)",
                observed_rate(falling(0.3, part, 4)), part, {1e-13 * part, "powers up to 3"},
                {{0, small_is_dropped}}, small_is_dropped);
}

EXERCISE_TEST(ObservedRate, LooksAtTheSecondHalf) {
  for (const int n : {6, 7}) {
    // Counted from 1, m is 3 of 6 entries and 4 of 7.
    const std::size_t m = n == 6 ? 3 : 4;
    std::vector<double> history(static_cast<std::size_t>(n));
    for (std::size_t k = 1; k <= history.size(); ++k)
      history[k - 1] =
          k <= m ? std::pow(0.5, double(k)) : std::pow(0.5, double(m)) * std::pow(0.9, double(k - m));
    for (std::size_t k = m; k + 1 < history.size(); ++k) history[k] *= 1.1;  // only these two entries count
    const auto drop = [&](std::size_t from) {
      return std::pow(history.back() / history[from - 1], 1 / double(history.size() - from));
    };
    expect_near(
        "rate of " + std::to_string(n) + " entries, 0.5 to entry " + std::to_string(m) +
            " and 0.9 from there on",
        "Eq. (10.5)", observed_rate(history), 0.9, {1e-13, "round-off of powers"},
        {{drop(1),
          "This is over the whole history. Leave out the first sweeps, which are not typical: m is ⌈n/2⌉."},
         {drop(history.size() - 1), "These are the last two entries alone, which may be round-off."},
         {drop(m - 1), "m = ⌈n/2⌉, counted from 1: this began one entry too early."},
         {drop(m + 1), "m = ⌈n/2⌉, counted from 1: this began one entry too late."}},
        "(e_n/e_m)^(1/(n - m)), of these two entries alone: without a mean or a fit.");
  }
}

EXERCISE_TEST(ObservedRate, FindsTheRateOfAStack) {
  Problem<3> p = stack({1, 100}, 0.1);
  std::vector<double> history = {1, 0.5};
  observed_rate(history);
  history = solve(p.rows, p.V, {.max_sweeps = 100, .tolerance = 0}).history;
  expect_near("rate of a stack, 1 kg under 100 kg", "Eq. (4.10)", observed_rate(history), 1 / 1.01,
              {1e-9, "the history's round-off over its smallest entry"});
}

EXERCISE_TEST(ObservedRate, UsesTwoEntriesOnly) {
  // The third and the last of six entries count.
  for (const double other : {0.0, -1.0, std::nan("")})
    expect_near("rate of six entries, of which the irrelevant ones are " + show(other), "Eq. (10.5)",
                observed_rate({other, other, 0.8, other, other, 0.1}), 0.5, roundings(8), {},
                "Only e_m and e_n have to be positive: the others have no part in it.");
}

EXERCISE_TEST(ObservedRate, IsNoNumberWithoutTwoThatArePositive) {
  const double nan = std::nan("");
  const std::string short_one = "Fewer than two entries have no rate: return NaN.";
  expect_true("no entries: NaN", "Eq. (10.5)", std::isnan(observed_rate({})), short_one);
  expect_true("one entry: NaN", "Eq. (10.5)", std::isnan(observed_rate({0.5})), short_one);
  const std::string zero = "A history that ends at exactly 0 has no rate: return NaN, neither 0 nor infinity.";
  expect_true("the last is 0: NaN", "Eq. (10.5)", std::isnan(observed_rate({1, 0.5, 0.1, 0})), zero);
  expect_true("the middle one is 0: NaN", "Eq. (10.5)", std::isnan(observed_rate({1, 0, 0.1, 0.1})), zero);
  expect_true("a NaN at the end: NaN", "Eq. (10.5)", std::isnan(observed_rate({1, 0.5, nan})),
              "Ask whether both are > 0, which is false for NaN. To ask whether one is <= 0 misses a NaN.");
  expect_true("two negative entries: NaN", "Eq. (10.5)", std::isnan(observed_rate({1, -0.5, 0.2, -0.1})),
              "A sweep never returns a negative number: such a history is invalid.");
}

}  // namespace
