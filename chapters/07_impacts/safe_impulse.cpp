#include "07_impacts/impacts.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Vec3 safe_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e, double mu) {
  // Eq. (7.7), (7.8); what goes in and out, and in which units, is in impacts.hpp.
  not_implemented("7.5 safe_impulse", K, u, n, e, mu);
}

}  // namespace spook
