#include "14_fast_rows/fast_rows.hpp"
#include "common/not_implemented.hpp"

namespace spook {

std::vector<int> colour_pairs(const std::vector<Pair>& pairs, std::size_t bodies) {
  // Eq. (14.7); what goes in and out is in fast_rows.hpp.
  not_implemented("14.3 colour_pairs", pairs, bodies);
}

}  // namespace spook
