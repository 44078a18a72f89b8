// Wrong: returns the place of each row.
// Killed by: OrderAlong.GoesFromTheLowestToTheHighest
// Says: The order says which row is at each place
#include <algorithm>
#include <cmath>
#include <numeric>

#include "10_convergence/convergence.hpp"

namespace spook {

std::vector<int> order_along(const std::vector<double>& heights) {
  std::vector<int> order(heights.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return heights[a] < heights[b] || (std::isnan(heights[b]) && !std::isnan(heights[a]));
  });
  std::vector<int> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = static_cast<int>(k);
  return place;
}

}  // namespace spook
