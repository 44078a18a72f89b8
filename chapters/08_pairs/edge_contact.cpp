#include "08_pairs/pairs.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Contact edge_contact(const Box& i, const Box& j, const SeparatingAxis& axis) {
  // Eq. (8.3), (8.9); what goes in and out, and in which units, is in pairs.hpp.
  not_implemented("8.7 edge_contact", i, j, axis);
}

}  // namespace spook
