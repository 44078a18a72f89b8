#include "14_fast_rows/fast_rows.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Vec3 solve_on_cone(const Mat3& S, const Vec3& q, double mu) {
  // Eq. (14.3)-(14.6); what goes in and out, and in which units, is in fast_rows.hpp.
  not_implemented("14.1 solve_on_cone", S, q, mu);
}

}  // namespace spook
