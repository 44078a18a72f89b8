#pragma once
// Integrates y' = f(y) nearly to round-off, for answers without a closed form. Independent of the engine.
//
// A step of H by Gragg's midpoint rule in n = 2, 4, 6, … parts has an error in even powers of H/n only. So
// extrapolation of several n to n = ∞, as a polynomial in (H/n)², gains two orders with each n. H is halved if the
// values do not converge. Each call continues from the time of the last call; a short interval costs about twenty
// evaluations of f.
//
// Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.9.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "engine/support/state_stream.hpp"

namespace spook {

template <int N>
class ReferenceMotion {
 public:
  using State = Eigen::Matrix<double, N, 1>;
  using Rate = std::function<State(const State&)>;

  /// Starts from `start` at time 0. `tolerance` bounds the change by the last extrapolation of a step, relative to the
  /// largest number of the state or to 1. After each step `settle`, if given, may project the state on its conserved
  /// quantities.
  ReferenceMotion(Rate rate, const State& start, double tolerance = 1e-13, Rate settle = nullptr)
      : rate_(std::move(rate)), settle_(std::move(settle)), state_(start), tolerance_(tolerance) {}

  /// Returns the state at `t`, which must not be before that of the last call. Throws std::runtime_error if no step is
  /// short enough, because the motion is not smooth or not finite.
  const State& at(double t) {
    while (time_ < t) {
      const double rest = t - time_;
      const double H = std::min(rest, longest_);
      int extrapolations = 0;
      if (!step(H, extrapolations)) {
        longest_ = H / 2;
        if (!(time_ + longest_ > time_)) throw std::runtime_error("the reference motion cannot go on");
        continue;
      }
      time_ = H < rest ? time_ + H : t;
      if (extrapolations < max_extrapolations / 2 && H == longest_) longest_ = 2 * H;
    }
    return state_;
  }

  void state(StateStream& s) { s(state_, time_, longest_); }

 private:
  static constexpr int max_extrapolations = 8;

  State midpoint_rule(double H, int parts) const {
    const double h = H / parts;
    State before = state_, now = state_ + h * rate_(state_);
    for (int n = 1; n < parts; ++n) {
      const State next = before + 2 * h * rate_(now);
      before = now;
      now = next;
    }
    return (before + now + h * rate_(now)) / 2;
  }

  bool step(double H, int& extrapolations) {
    std::array<State, max_extrapolations + 1> row;  // a row of Neville's table, the best value last
    for (int k = 0; k <= max_extrapolations; ++k) {
      State better = midpoint_rule(H, 2 * (k + 1));
      for (int m = 0; m < k; ++m) {
        const double ratio = (k + 1.0) / (k - m);  // ratio of the two numbers of parts
        const State next = better + (better - row[static_cast<std::size_t>(m)]) / (ratio * ratio - 1);
        row[static_cast<std::size_t>(m)] = better;
        better = next;
      }
      row[static_cast<std::size_t>(k)] = better;
      if (k == 0) continue;
      const double change = (better - row[static_cast<std::size_t>(k - 1)]).cwiseAbs().maxCoeff();
      if (better.allFinite() && change <= tolerance_ * std::max(1.0, state_.cwiseAbs().maxCoeff())) {
        state_ = settle_ ? settle_(better) : better;
        extrapolations = k;
        return true;
      }
    }
    return false;
  }

  Rate rate_, settle_;
  State state_;
  double tolerance_;
  double time_ = 0;
  double longest_ = std::numeric_limits<double>::infinity();
};

}  // namespace spook
