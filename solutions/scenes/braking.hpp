#pragma once
// A motion that is slowed at a constant rate until it stands still: what dry friction does.
//
//   x = v0 t - ½ r t²,  v = v0 - r t    for t <= v0/r
#include <algorithm>

namespace spook {

struct Braking {
  double v0;    ///< >= 0
  double rate;  ///< r >= 0; 0: it never stops

  double duration() const { return v0 / rate; }

  /// Before time 0 as well: it was faster then.
  double v(double t) const { return std::max(0.0, v0 - rate * t); }

  double way(double t) const {
    t = std::min(t, duration());
    return v0 * t - rate * t * t / 2;
  }
};

}  // namespace spook
