#include "05_friction_box/friction_box.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Vec3 friction_impulse(const Mat3& K, const Vec3& u, const Tangents& tangents, double Gamma, double bound) {
  // Eq. (5.3), (5.8); what goes in and out, and in which units, is in friction_box.hpp.
  not_implemented("5.6 friction_impulse", K, u, tangents, Gamma, bound);
}

}  // namespace spook
