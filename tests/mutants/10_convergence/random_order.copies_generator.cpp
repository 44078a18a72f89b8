// Wrong: uses a copy of the generator.
// Killed by: RandomOrder.ComesFromTheGenerator
// Says: is it a copy
#include <algorithm>
#include <numeric>

#include "10_convergence/convergence.hpp"

namespace spook {

std::vector<int> random_order(int n, std::mt19937_64& generator) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  std::mt19937_64 copy = generator;
  std::shuffle(order.begin(), order.end(), copy);
  return order;
}

}  // namespace spook
