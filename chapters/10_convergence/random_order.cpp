#include "10_convergence/convergence.hpp"
#include "common/not_implemented.hpp"

namespace spook {

std::vector<int> random_order(int n, std::mt19937_64& generator) {
  // Eq. (10.4); what goes in and out, and in which units, is in convergence.hpp.
  not_implemented("10.4 random_order", n, generator);
}

}  // namespace spook
