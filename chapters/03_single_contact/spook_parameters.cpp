#include "03_single_contact/single_contact.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

SpookParameters spook_parameters(double h, double k, double d) {
  // Eq. (3.4), (3.5), (3.6); what goes in and out, and in which units, is in single_contact.hpp.
  not_implemented("3.1 spook_parameters", h, k, d);
}

}  // namespace spook
