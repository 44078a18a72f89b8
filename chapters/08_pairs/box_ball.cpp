#include "08_pairs/pairs.hpp"
#include "common/not_implemented.hpp"

namespace spook {

std::optional<Contact> box_ball(const Box& box, const Ball& ball) {
  // Eq. (8.3), (8.5); what goes in and out, and in which units, is in pairs.hpp.
  not_implemented("8.4 box_ball", box, ball);
}

}  // namespace spook
