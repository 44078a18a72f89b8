#pragma once
#include <cmath>

namespace spook {

/// The larger of the two; NaN if either is NaN, unlike std::max.
inline double larger(double a, double b) {
  return std::isnan(b) || b > a ? b : a;
}

}  // namespace spook
