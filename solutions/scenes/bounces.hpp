#pragma once
// The closed form of a dropped ball that bounces with restitution e: Eq. (7.11), (7.12).
//
//   falls for t0 = √(2h0/g), then flies for 2 e t0, 2 e² t0, …    peaks h0 e^(2n)    ends at t0 (1+e)/(1-e)
#include "engine/support/state_stream.hpp"

namespace spook {

class Bounces {
 public:
  /// A ball dropped from h0 > 0 [m], with g > 0 [m/s²] and 0 <= e <= 1.
  Bounces(double h0, double g, double e);

  double peak(int bounces) const;  ///< height of the peak after so many bounces [m]
  double end() const;              ///< time of the last bounce [s]; infinite for e = 1

  /// The height at time `t` >= 0 [m]. `t` must not be before that of the last call.
  double height(double t);

  void state(StateStream& s) { s(since_, speed_); }

 private:
  double h0_, g_, e_;
  double t0_;             // [s]
  double since_, speed_;  // of the current flight: its start [s], and its initial speed [m/s]
};

}  // namespace spook
