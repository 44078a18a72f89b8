#include "08_pairs/pairs.hpp"
#include "common/not_implemented.hpp"

namespace spook {

std::optional<Contact> plane_ball(const Plane& plane, const Ball& ball) {
  // Eq. (8.1), (8.3); what goes in and out, and in which units, is in pairs.hpp.
  not_implemented("8.1 plane_ball", plane, ball);
}

}  // namespace spook
