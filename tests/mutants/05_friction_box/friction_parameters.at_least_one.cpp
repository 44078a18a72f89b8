// Wrong: takes a viscosity below 1 N s/m for none.
// Killed by: FrictionParameters.TakeAnyPositiveViscosity
// Says: c must be positive
#include "05_friction_box/friction_box.hpp"
#include "common/require.hpp"

namespace spook {

Spook friction_parameters(double h, double c) {
  require_positive("h", h);
  if (!(c >= 1)) reject("c", c, "positive; it may be infinite");
  return {.a = 0, .b = 1, .Sigma = 1 / (h * c)};
}

}  // namespace spook
