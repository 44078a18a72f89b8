#include "scenes/plane_pendulum.hpp"

#include <cmath>

#include "scenes/elliptic.hpp"

namespace spook {

PlanePendulum::PlanePendulum(double angle0, double rate)
    : sin_half_(std::sin(angle0 / 2)), cos_half_(std::cos(angle0 / 2)), rate_(rate) {}

PlanePendulum::Direction PlanePendulum::direction(double t) const {
  const Jacobi f = jacobi(rate_ * t, cos_half_ * cos_half_);
  const double s = sin_half_ * f.cn / f.dn;
  const double c = cos_half_ / f.dn;
  return {.sin = 2 * s * c, .cos = c * c - s * s};
}

double PlanePendulum::period() const {
  return 4 * quarter_period(cos_half_ * cos_half_) / rate_;
}

}  // namespace spook
