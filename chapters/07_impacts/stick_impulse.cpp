#include "07_impacts/impacts.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Vec3 stick_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e) {
  // Eq. (7.2), (7.3); what goes in and out, and in which units, is in impacts.hpp.
  not_implemented("7.1 stick_impulse", K, u, n, e);
}

}  // namespace spook
