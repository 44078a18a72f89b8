// Wrong: looks at the bounds below only.
// Killed by: LongestStep.EndsAtTheFirstBound
// Says: Four vectors are to stay >= 0
#include <algorithm>

#include "11_direct/direct.hpp"

namespace spook {

double longest_step(const Interior& now, const Interior& step) {
  double longest = 1;
  const auto keep_positive = [&](const Vector& value, const Vector& change) {
    for (Eigen::Index k = 0; k < value.size(); ++k)
      if (change[k] < 0) longest = std::min(longest, -value[k] / change[k]);
  };
  keep_positive(now.room_lo, step.room_lo);
  keep_positive(now.push_lo, step.push_lo);
  return longest;
}

}  // namespace spook
