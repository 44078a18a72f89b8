#include "01_leapfrog/leapfrog.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Vec3 drift(const Vec3& x, const Vec3& v, double h) {
  // Eq. (1.4); what goes in and out, and in which units, is in leapfrog.hpp.
  not_implemented("1.2 drift", x, v, h);
}

}  // namespace spook
