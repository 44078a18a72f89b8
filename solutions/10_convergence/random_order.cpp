#include <algorithm>
#include <numeric>

#include "10_convergence/convergence.hpp"

namespace spook {

std::vector<int> random_order(int n, std::mt19937_64& generator) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  // Each place gets an index that has no place yet.                            Eq. (10.4)
  for (int last = n - 1; last > 0; --last)
    std::swap(order[last], order[std::uniform_int_distribution(0, last)(generator)]);
  return order;
}

}  // namespace spook
