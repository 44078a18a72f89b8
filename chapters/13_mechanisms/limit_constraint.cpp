#include "13_mechanisms/mechanisms.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Constraint<6> limit_constraint(const Coordinate& free, const JointLimits& limits, const SpookParameters& spook,
                               double h) {
  // Eq. (13.10), (13.11); what goes in and out, and in which units, is in mechanisms.hpp.
  not_implemented("13.4 limit_constraint", free, limits, spook, h);
}

}  // namespace spook
