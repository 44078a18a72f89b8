#include "08_pairs/pairs.hpp"
#include "common/not_implemented.hpp"

namespace spook {

std::vector<Contact> well_spread(const std::vector<Contact>& contacts) {
  // Eq. (8.10); what goes in and out, and in which units, is in pairs.hpp.
  not_implemented("8.7 well_spread", contacts);
}

}  // namespace spook
