#include "03_single_contact/single_contact.hpp"
#include "common/require.hpp"

namespace spook {

SpookParameters spook_parameters(double h, double k, double d) {
  require_positive("h", h);
  require_positive("k", k);
  require_not_negative("d", d);
  const double upsilon = 1 / (1 + 4 * d);
  return {.a = 4 * upsilon / h,                 // Eq. (3.4)
          .b = 4 * d * upsilon,                 // Eq. (3.5)
          .Sigma = 4 * upsilon / (h * h * k)};  // Eq. (3.6)
}

}  // namespace spook
