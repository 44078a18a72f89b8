#include "05_friction_box/friction_box.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Tangents tangents(const Vec3& n) {
  // Eq. (5.1); what goes in and out, and in which units, is in friction_box.hpp.
  not_implemented("5.1 tangents", n);
}

}  // namespace spook
