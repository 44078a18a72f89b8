#include "05_friction_box/friction_box.hpp"
#include "common/require.hpp"

namespace spook {

SpookParameters friction_parameters(double h, double c) {
  require_positive("h", h);
  if (!(c > 0)) reject("c", c, "positive; it may be infinite");
  return {.a = 0, .b = 1, .Sigma = 1 / (h * c)};  // Eq. (5.3), (5.4)
}

}  // namespace spook
