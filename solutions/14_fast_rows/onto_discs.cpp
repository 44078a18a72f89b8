#include "14_fast_rows/fast_rows.hpp"

namespace spook {

LanePairs onto_discs(const LanePairs& lambda, const Lanes& radius) {
  const Lanes length = (lambda.col(0) * lambda.col(0) + lambda.col(1) * lambda.col(1)).sqrt();
  // A comparison with a NaN is false, so this order keeps the NaN. An empty lane is inside; its 0/0 is not selected.
  const Lanes scale = (length <= radius).select(1.0, radius / length);  // Eq. (14.14)
  return lambda.colwise() * scale;
}

}  // namespace spook
