#include "09_better_friction/better_friction.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Vec2 onto_disc(const Vec2& lambda, double radius) {
  // Eq. (9.4); what goes in and out, and in which units, is in better_friction.hpp.
  not_implemented("9.4 onto_disc", lambda, radius);
}

}  // namespace spook
