#include "10_convergence/convergence.hpp"
#include "common/not_implemented.hpp"

namespace spook {

std::vector<int> order_along(const std::vector<double>& heights) {
  // Eq. (10.3); what goes in and out, and in which units, is in convergence.hpp.
  not_implemented("10.3 order_along", heights);
}

}  // namespace spook
