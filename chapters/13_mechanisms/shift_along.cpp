#include "13_mechanisms/mechanisms.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Coordinate shift_along(const JointFrame& i, const JointFrame& j, int axis) {
  // Eq. (13.5), (13.6); what goes in and out, and in which units, is in mechanisms.hpp.
  not_implemented("13.2 shift_along", i, j, axis);
}

}  // namespace spook
