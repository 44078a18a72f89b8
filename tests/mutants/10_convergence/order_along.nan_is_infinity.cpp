// Wrong: takes a NaN for an infinite height.
// Killed by: OrderAlong.PutsANaNLast
// Says: not to be taken for ∞
#include <algorithm>
#include <cmath>
#include <numeric>

#include "10_convergence/convergence.hpp"

namespace spook {

std::vector<int> order_along(const std::vector<double>& heights) {
  std::vector<int> order(heights.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    const auto height = [&](int k) { return std::isnan(heights[k]) ? HUGE_VAL : heights[k]; };
    return height(a) < height(b);
  });
  return order;
}

}  // namespace spook
