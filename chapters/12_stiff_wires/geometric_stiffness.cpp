#include "12_stiff_wires/stiff_wires.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Mat3 geometric_stiffness(const Vec3& n, double length, double tension) {
  // Eq. (12.3), (12.4); what goes in and out, and in which units, is in stiff_wires.hpp.
  not_implemented("12.2 geometric_stiffness", n, length, tension);
}

}  // namespace spook
