// Wrong: returns the last limit, not the first.
// Killed by: LongestStep.EndsAtTheFirstBound
// Says: not the last
#include <algorithm>

#include "11_direct/direct.hpp"

namespace spook {

double longest_step(const Interior& now, const Interior& step) {
  double longest = 1;
  const auto keep_positive = [&](const Vector& value, const Vector& change) {
    for (Eigen::Index k = 0; k < value.size(); ++k)
      if (change[k] < 0) longest = std::max(longest < 1 ? longest : 0.0, std::min(1.0, -value[k] / change[k]));
  };
  keep_positive(now.room_lo, step.room_lo);
  keep_positive(now.room_hi, step.room_hi);
  keep_positive(now.push_lo, step.push_lo);
  keep_positive(now.push_hi, step.push_hi);
  return longest;
}

}  // namespace spook
