#include "01_leapfrog/leapfrog.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  // Eq. (1.3); what goes in and out, and in which units, is in leapfrog.hpp.
  not_implemented("1.1 kick", v, f, inverse_mass, h);
}

}  // namespace spook
