#include "08_pairs/pairs.hpp"
#include "common/not_implemented.hpp"

namespace spook {

std::optional<Contact> ball_ball(const Ball& i, const Ball& j) {
  // Eq. (8.2), (8.3); what goes in and out, and in which units, is in pairs.hpp.
  not_implemented("8.2 ball_ball", i, j);
}

}  // namespace spook
