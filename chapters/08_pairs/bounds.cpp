#include "08_pairs/pairs.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Bounds bounds(const Box& box) {
  // Eq. (8.11); what goes in and out, and in which units, is in pairs.hpp.
  not_implemented("8.9 bounds", box);
}

}  // namespace spook
