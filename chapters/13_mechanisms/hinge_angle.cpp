#include "13_mechanisms/mechanisms.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Coordinate hinge_angle(const JointFrame& i, const JointFrame& j, double last) {
  // Eq. (13.8), (13.9); what goes in and out, and in which units, is in mechanisms.hpp.
  not_implemented("13.3 hinge_angle", i, j, last);
}

}  // namespace spook
