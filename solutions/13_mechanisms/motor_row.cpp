#include "13_mechanisms/mechanisms.hpp"
#include "common/require.hpp"

namespace spook {

Row<6> motor_row(const Coordinate& free, const Motor& motor, double h, const Motion<6>& motion) {
  require_finite("speed", motor.speed);
  if (!(motor.strength >= 0)) reject("strength", motor.strength, "at least 0; it may be infinite");
  if (!(motor.viscosity > 0)) reject("viscosity", motor.viscosity, "positive; it may be infinite");
  const double most = h * motor.strength;
  Row<6> row = make_row<6>({.i = free.i,
                            .j = free.j,
                            .Gi = free.Gi,
                            .Gj = free.Gj,
                            .gap = 0,
                            .spook = friction_parameters(h, motor.viscosity),  // Eq. (13.12)
                            .lo = -most,
                            .hi = most},
                           motion);
  row.B += motor.speed;  // Eq. (13.13)
  return row;
}

}  // namespace spook
