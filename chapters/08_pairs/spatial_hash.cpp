#include "08_pairs/pairs.hpp"
#include "common/not_implemented.hpp"

namespace spook {

std::vector<Pair> spatial_hash(const std::vector<Bounds>& bounds) {
  // Eq. (8.13), (8.14); what goes in and out, and in which units, is in pairs.hpp.
  not_implemented("8.11 spatial_hash", bounds);
}

}  // namespace spook
