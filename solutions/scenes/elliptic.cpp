#include "scenes/elliptic.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace spook {

// The means converge quadratically; this suffices for any k'.
static constexpr int max_levels = 40;
static constexpr double epsilon = std::numeric_limits<double>::epsilon();

Jacobi jacobi(double u, double complement) {
  if (complement == 0) return {std::tanh(u), 1 / std::cosh(u), 1 / std::cosh(u)};

  std::array<double, max_levels + 1> a{}, c{};  // means, and half differences
  a[0] = 1;
  c[0] = std::sqrt(1 - complement);
  double b = std::sqrt(complement);
  int n = 0;
  while (n < max_levels &&
         std::abs(c[static_cast<std::size_t>(n)]) > epsilon * a[static_cast<std::size_t>(n)]) {
    const auto now = static_cast<std::size_t>(n++);
    a[now + 1] = (a[now] + b) / 2;
    c[now + 1] = (a[now] - b) / 2;
    b = std::sqrt(a[now] * b);
  }

  double phi = std::ldexp(a[static_cast<std::size_t>(n)] * u, n);
  for (; n > 0; --n) {
    const auto level = static_cast<std::size_t>(n);
    phi = (phi + std::asin(c[level] / a[level] * std::sin(phi))) / 2;
  }
  const double sn = std::sin(phi), cn = std::cos(phi);
  return {sn, cn, std::sqrt(cn * cn + complement * sn * sn)};
}

double elliptic_integral(double phi, double complement) {
  if (complement == 0)
    return std::abs(phi) < std::numbers::pi / 2 ? std::atanh(std::sin(phi)) : std::copysign(INFINITY, phi);

  double a = 1, b = std::sqrt(complement);
  int n = 0;
  for (; n < max_levels && std::abs(a - b) > epsilon * a; ++n) {
    // Landen: tan(φ' - φ) = (b/a) tan φ, in the quadrant that φ is in.
    const double turn = std::atan2(b * std::sin(phi), a * std::cos(phi));
    phi += turn + 2 * std::numbers::pi * std::round((phi - turn) / (2 * std::numbers::pi));
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return std::ldexp(phi / a, -n);
}

double quarter_period(double complement) {
  return elliptic_integral(std::numbers::pi / 2, complement);
}

}  // namespace spook
