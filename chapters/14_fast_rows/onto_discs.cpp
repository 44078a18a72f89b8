#include "14_fast_rows/fast_rows.hpp"
#include "common/not_implemented.hpp"

namespace spook {

LanePairs onto_discs(const LanePairs& lambda, const Lanes& radius) {
  // Eq. (14.14), (9.4); what goes in and out, and in which units, is in fast_rows.hpp.
  not_implemented("14.6 onto_discs", lambda, radius);
}

}  // namespace spook
