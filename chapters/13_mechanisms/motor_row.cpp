#include "13_mechanisms/mechanisms.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

Row<6> motor_row(const Coordinate& free, const Motor& motor, double h, const Motion<6>& motion) {
  // Eq. (13.12), (13.13); what goes in and out, and in which units, is in mechanisms.hpp.
  not_implemented("13.5 motor_row", free, motor, h, motion);
}

}  // namespace spook
