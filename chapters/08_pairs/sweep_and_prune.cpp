#include "08_pairs/pairs.hpp"
#include "common/not_implemented.hpp"

namespace spook {

std::vector<Pair> sweep_and_prune(const std::vector<Bounds>& bounds) {
  // Eq. (8.12); what goes in and out, and in which units, is in pairs.hpp.
  not_implemented("8.10 sweep_and_prune", bounds);
}

}  // namespace spook
