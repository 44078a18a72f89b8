#pragma once
// The closed form of a ball that is dropped, and bounces with restitution e: Eq. (7.11), (7.12).
//
//   falls for t0 = √(2h0/g), then flies for 2 e t0, 2 e² t0, …    peaks h0 e^(2n)    ends at t0 (1+e)/(1-e)
namespace spook {

class Bounces {
 public:
  /// h0 > 0 [m], g > 0 [m/s²], 0 <= e <= 1.
  Bounces(double h0, double g, double e);

  double peak(int bounces) const;  ///< after so many of them [m]
  double end() const;              ///< of all bounces [s]; infinite for e = 1

  /// At time `t`, not before that of the last call, nor before 0 [m].
  double height(double t);

 private:
  double h0_, g_, e_;
  double t0_;             // [s]
  double since_, speed_;  // of the present flight: its begin [s], and how fast it began [m/s]
};

}  // namespace spook
