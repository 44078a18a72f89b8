#pragma once
// Motion with constant deceleration until rest, as by dry friction.
//
//   x = v0 t - ½ r t²,  v = v0 - r t    for t <= v0/r
#include <algorithm>

namespace spook {

struct Braking {
  double v0;    ///< >= 0
  double rate;  ///< r >= 0; 0: never stops

  double duration() const { return v0 / rate; }

  /// The speed [m/s]; also valid before time 0.
  double v(double t) const { return std::max(0.0, v0 - rate * t); }

  double way(double t) const {
    t = std::min(t, duration());
    return v0 * t - rate * t * t / 2;
  }
};

}  // namespace spook
