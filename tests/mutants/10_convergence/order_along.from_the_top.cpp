// Wrong: begins with the highest.
// Killed by: OrderAlong.GoesFromTheLowestToTheHighest
// Says: from the highest to the lowest
#include <algorithm>
#include <cmath>
#include <numeric>

#include "10_convergence/convergence.hpp"

namespace spook {

std::vector<int> order_along(const std::vector<double>& heights) {
  std::vector<int> order(heights.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return heights[a] > heights[b] || (std::isnan(heights[b]) && !std::isnan(heights[a]));
  });
  return order;
}

}  // namespace spook
