#include "scenes/free_top.hpp"

#include <algorithm>
#include <cmath>

#include "common/require.hpp"
#include "scenes/elliptic.hpp"

namespace spook {

FreeTop::FreeTop(const Vec3& I, const Vec3& w) {
  require_positive("I1", I[0]);
  if (!(I[1] > I[0])) reject("I2", I[1], "more than I1");
  if (!(I[2] > I[1] && std::isfinite(I[2]))) reject("I3", I[2], "more than I2, and finite");
  require_all_finite("omega", w);
  if (w.isZero(0)) throw std::invalid_argument("omega must not be zero");

  // L² - 2T I_axis as a sum over the other axes: the difference itself would cancel digits.
  const auto excess = [&](int axis) {
    double sum = 0;
    for (int other = 0; other < 3; ++other) sum += I[other] * (I[other] - I[axis]) * w[other] * w[other];
    return sum;
  };
  c_ = excess(1) > 0 ? 2 : 0;
  a_ = 2 - c_;
  const double a = I[a_], b = I[1], c = I[c_];
  const double P = -excess(c_), Q = excess(a_);
  const double A = std::sqrt(P / (a * (c - a)));
  const double B = std::sqrt(P / (b * (c - b)));
  const double C = std::sqrt(Q / (c * (c - a)));

  // Euler's equations couple the signs: their product is +1.
  const double sign_a = std::copysign(1.0, w[a_]), sign_c = std::copysign(1.0, w[c_]);
  amplitude_[a_] = sign_a * A;
  amplitude_[1] = sign_a * sign_c * B;
  amplitude_[c_] = sign_c * C;
  rate_ = std::sqrt((c - b) * Q / (a * b * c));
  complement_ = std::clamp((c - a) * excess(1) / ((c - b) * Q), 0.0, 1.0);
  u0_ = P == 0 ? 0 : elliptic_integral(std::atan2(w[1] / amplitude_[1], w[a_] / amplitude_[a_]), complement_);
}

Vec3 FreeTop::omega(double t) const {
  const Jacobi f = jacobi(rate_ * t + u0_, complement_);
  Vec3 w;
  w[a_] = amplitude_[a_] * f.cn;
  w[1] = amplitude_[1] * f.sn;
  w[c_] = amplitude_[c_] * f.dn;
  return w;
}

double FreeTop::period() const {
  return 4 * quarter_period(complement_) / rate_;
}

}  // namespace spook
