#include "08_pairs/pairs.hpp"
#include "common/not_implemented.hpp"

namespace spook {

void box_box(const Box& i, const Box& j, std::vector<Contact>& contacts) {
  // Eq. (8.3), (8.6)-(8.10); what goes in and out, and in which units, is in pairs.hpp.
  not_implemented("8.8 box_box", i, j, contacts);
}

}  // namespace spook
