#include "scenes/bounces.hpp"

#include <cmath>

namespace spook {

// The first fall is the second half of a flight that started at -t0.
Bounces::Bounces(double h0, double g, double e)
    : h0_(h0), g_(g), e_(e), t0_(std::sqrt(2 * h0 / g)), since_(-t0_), speed_(g * t0_) {}

double Bounces::peak(int bounces) const {
  return h0_ * std::pow(e_, 2 * bounces);
}

double Bounces::end() const {
  return t0_ * (1 + e_) / (1 - e_);
}

double Bounces::height(double t) {
  if (t >= end()) return 0;
  // Close to the end, a flight may be shorter than the round-off of the time.
  while (speed_ > 0 && t >= since_ + 2 * speed_ / g_) {
    since_ += 2 * speed_ / g_;
    speed_ *= e_;
  }
  const double flown = t - since_;
  return speed_ * flown - g_ * flown * flown / 2;
}

}  // namespace spook
