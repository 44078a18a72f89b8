#include "08_pairs/pairs.hpp"
#include "common/not_implemented.hpp"

namespace spook {

SeparatingAxis separating_axis(const Box& i, const Box& j) {
  // Eq. (8.6), (8.7); what goes in and out, and in which units, is in pairs.hpp.
  not_implemented("8.5 separating_axis", i, j);
}

}  // namespace spook
