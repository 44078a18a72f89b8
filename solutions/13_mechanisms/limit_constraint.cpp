#include "13_mechanisms/mechanisms.hpp"

namespace spook {

Constraint<6> limit_constraint(const Coordinate& free, const JointLimits& limits, const SpookParameters& spook,
                               double h) {
  const double above = free.value - limits.lower, below = limits.upper - free.value;  // Eq. (13.10)
  const double sign = above <= below ? 1 : -1, gap = std::min(above, below);
  Constraint<6> row{.i = free.i,
                    .j = free.j,
                    .Gi = sign * free.Gi,
                    .Gj = sign * free.Gj,
                    .gap = gap,
                    .spook = spook,
                    .lo = 0,
                    .hi = infinity};
  if (gap > 0) row.spook.a = 1 / h;  // Eq. (13.11)
  row.spook.b = 1;
  return row;
}

}  // namespace spook
