// Wrong: draws each index anew.
// Killed by: RandomOrder.HasEachIndexOnce
// Says: none twice and none left out
#include <algorithm>
#include <numeric>

#include "10_convergence/convergence.hpp"

namespace spook {

std::vector<int> random_order(int n, std::mt19937_64& generator) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  for (int& k : order) k = std::uniform_int_distribution(0, n - 1)(generator);
  return order;
}

}  // namespace spook
