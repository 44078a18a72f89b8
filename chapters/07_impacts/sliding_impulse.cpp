#include "07_impacts/impacts.hpp"
#include "common/not_implemented.hpp"

namespace spook {

std::optional<Vec3> sliding_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e, double mu) {
  // Eq. (7.5); what goes in and out, and in which units, is in impacts.hpp.
  not_implemented("7.3 sliding_impulse", K, u, n, e, mu);
}

}  // namespace spook
