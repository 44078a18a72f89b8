#pragma once
// A body without forces and torques, and its known motion.
#include "exercise_test.hpp"
#include "rotations.hpp"

namespace spook::testing {

struct Top {
  Vec3 principal;
  Quat q;
  Vec3 omega;  // world coordinates

  void step(double h) { free_rotation(q, omega, principal, h); }
  Vec3 omega_body() const { return q.conjugate() * omega; }
  Vec3 L() const { return q * Vec3(principal.cwiseProduct(omega_body())); }
  double energy() const { return omega_body().cwiseAbs2().dot(principal) / 2; }
};

inline Top after(Top top, double time, double h) {
  const int steps = static_cast<int>(std::lround(time / h));
  for (int n = 0; n < steps; ++n) top.step(time / steps);
  return top;
}

/// Three different moments, and a spin about none of the principal axes.
inline Top random_top(Random& random) {
  Top top;
  top.principal = {random.uniform(2, 2.3), random.uniform(3, 3.3), random.uniform(4, 4.3)};
  top.q = random.rotation();
  top.omega = top.q * random.vector(0.5, 1);
  return top;
}

/// Moments 1, 2, 3, spinning nearly about the middle axis. This spin is unstable: the body tumbles over every
/// half period.
inline Top tumbling_top() {
  return {Vec3(1, 2, 3), Quat(1, 0, 0, 0), Vec3(0.01, 1, 0.01)};
}

/// The complete elliptic integral K(k) from k'² = 1 - k²: π/2 over the arithmetic-geometric mean of 1 and k'. Not every
/// C++ library has std::comp_ellint_1. Source: Abramowitz and Stegun, 17.6.3.
inline double complete_elliptic_integral(double complement) {
  double a = 1, b = std::sqrt(complement);
  for (int level = 0; level < 8; ++level) {  // quadratic: six are exact for the top below
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return M_PI / 2 / a;
}

/// The period of its ω in body coordinates, 4 K(k)/ω_p = 39.1057 s: Eq. (2.12).
inline double tumbling_period() {
  const Top top = tumbling_top();
  const double I1 = top.principal[0], I2 = top.principal[1], I3 = top.principal[2];
  const double T = top.energy(), L_squared = top.L().squaredNorm();
  const double omega_p = std::sqrt((I3 - I2) * (L_squared - 2 * T * I1) / (I1 * I2 * I3));
  const double k_squared = (I2 - I1) * (2 * T * I3 - L_squared) / ((I3 - I2) * (L_squared - 2 * T * I1));
  return 4 * complete_elliptic_integral(1 - k_squared) / omega_p;
}

/// Integrates the same motion directly: q' = ½ ω q with ω = I⁻¹ L and L constant, by `steps` Runge-Kutta steps
/// of order 4.
inline Top true_motion(const Top& start, double time, int steps) {
  const Vec3 L = start.L();
  const auto omega_at = [&](const Quat& q) -> Vec3 {
    const Quat u = q.normalized();
    return u * Vec3((u.conjugate() * L).cwiseQuotient(start.principal));
  };
  const auto rate = [&](const Vec4& c) -> Vec4 {
    const Quat q(c);
    const Vec3 omega = omega_at(q);
    return (Quat(0, omega.x(), omega.y(), omega.z()) * q).coeffs() / 2;
  };
  const double h = time / steps;
  Vec4 c = start.q.coeffs();
  for (int n = 0; n < steps; ++n) {
    const Vec4 k1 = rate(c), k2 = rate(c + h / 2 * k1), k3 = rate(c + h / 2 * k2), k4 = rate(c + h * k3);
    c += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  const Quat q = Quat(c).normalized();
  return {start.principal, q, omega_at(q)};
}

/// Returns the distance of two states: the chord between the orientations, and the relative difference of ω.
inline double distance(const Top& a, const Top& b) {
  const double sign = a.q.dot(b.q) < 0 ? -1 : 1;
  return std::hypot((coefficients(a.q) - sign * coefficients(b.q)).norm(),
                    (a.omega - b.omega).norm() / b.omega.norm());
}

/// For tests of conserved quantities: expects that a first step of 0.1 s or more changes the state.
inline void expect_moved(const Top& top, const Top& start) {
  expect_at_least("distance from the start in q and ω, after one step", "Eq. (2.10)", distance(top, start),
                  0.01, "it spins at about 1 rad/s", "The body has not moved: q and ω are changed in place.");
}

/// Calls expect_order for order 2, with steps h to h/8. An error as small as `exact` at the finest step passes,
/// too.
inline void expect_second_order(const std::string& what, const std::string& equation,
                                const std::function<double(double)>& error, double h, double exact,
                                const std::string& clue) {
  if (error(h / 8) <= exact) return;
  expect_order(what, equation, error, h, 3, 2, 0.1, clue);
}

}  // namespace spook::testing
