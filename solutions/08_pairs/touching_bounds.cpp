#include "08_pairs/touching_bounds.hpp"

#include <numeric>

#include "common/require.hpp"

namespace spook {

void require_sound(const std::vector<Bounds>& bounds) {
  for (const Bounds& one : bounds) {
    if (!one.lower.allFinite()) require_all_finite("lower", one.lower);
    if (!one.upper.allFinite()) require_all_finite("upper", one.upper);
    for (int k = 0; k < 3; ++k)
      if (one.upper[k] < one.lower[k]) reject("upper", one.upper[k], "at or above its lower");
  }
}

/// Sorts `pairs` by `number_of`; pairs with equal numbers keep their order.
template <class NumberOf>
static std::vector<Pair> ordered_by(const std::vector<Pair>& pairs, std::size_t n, const NumberOf& number_of) {
  std::vector<std::size_t> place(n + 1, 0);  // position of the next pair with this number
  for (const Pair& pair : pairs) ++place[static_cast<std::size_t>(number_of(pair)) + 1];
  std::partial_sum(place.begin(), place.end(), place.begin());
  std::vector<Pair> sorted(pairs.size());
  for (const Pair& pair : pairs) sorted[place[static_cast<std::size_t>(number_of(pair))]++] = pair;
  return sorted;
}

void sort_pairs(std::vector<Pair>& pairs, std::size_t n) {
  pairs = ordered_by(pairs, n, [](const Pair& pair) { return pair.second; });
  pairs = ordered_by(pairs, n, [](const Pair& pair) { return pair.first; });
}

}  // namespace spook
