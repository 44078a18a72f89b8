// Wrong: sorts by < alone.
// Killed by: OrderAlong.PutsANaNLast
// Says: leaves the others unsorted around it
#include <algorithm>
#include <numeric>

#include "10_convergence/convergence.hpp"

namespace spook {

std::vector<int> order_along(const std::vector<double>& heights) {
  std::vector<int> order(heights.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return heights[a] < heights[b]; });
  return order;
}

}  // namespace spook
