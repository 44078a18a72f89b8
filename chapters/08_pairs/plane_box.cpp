#include "08_pairs/pairs.hpp"
#include "common/not_implemented.hpp"

namespace spook {

void plane_box(const Plane& plane, const Box& box, std::vector<Contact>& contacts) {
  // Eq. (8.3), (8.4); what goes in and out, and in which units, is in pairs.hpp.
  not_implemented("8.3 plane_box", plane, box, contacts);
}

}  // namespace spook
