#include "09_better_friction/better_friction.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Tangents sliding_tangents(const Vec3& n, const Vec3& u, double slow) {
  // Eq. (9.2); what goes in and out, and in which units, is in better_friction.hpp.
  not_implemented("9.1 sliding_tangents", n, u, slow);
}

}  // namespace spook
