// Wrong: takes chance from elsewhere.
// Killed by: RandomOrder.ComesFromTheGenerator
// Says: from nothing else
#include <algorithm>
#include <numeric>

#include "10_convergence/convergence.hpp"

namespace spook {

std::vector<int> random_order(int n, std::mt19937_64&) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  static std::mt19937_64 own(1);
  std::shuffle(order.begin(), order.end(), own);
  return order;
}

}  // namespace spook
