// Wrong: begins at a random row, and goes round in order.
// Killed by: RandomOrder.MakesEveryOrderAsLikely
// Says: a random start, and then round in order
#include <algorithm>
#include <numeric>

#include "10_convergence/convergence.hpp"

namespace spook {

std::vector<int> random_order(int n, std::mt19937_64& generator) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  if (n > 0)
    std::rotate(order.begin(), order.begin() + std::uniform_int_distribution(0, n - 1)(generator), order.end());
  return order;
}

}  // namespace spook
