// The closed forms behind the scene `top`, against identities, a quadrature and an integration.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "scenes/elliptic.hpp"
#include "scenes/free_top.hpp"

namespace spook::free_top_test {
namespace {

constexpr double pi = 3.14159265358979323846;

/// F by the midpoint rule, which converges exponentially for a smooth periodic integrand, so for φ = π/2 only.
double quarter_period_by_quadrature(double complement) {
  const int n = 4000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double theta = (i + 0.5) * (pi / 2) / n;
    sum += 1 / std::sqrt(std::pow(std::cos(theta), 2) + complement * std::pow(std::sin(theta), 2));
  }
  return sum * (pi / 2) / n;
}

TEST(Elliptic, IntegralsAgreeWithQuadratureAndInvertTheFunctions) {
  for (const double complement : {1.0, 0.75, 0.5, 0.1, 1e-3}) {
    EXPECT_NEAR(quarter_period(complement), quarter_period_by_quadrature(complement), 1e-12);
    for (double phi = -3.1; phi < 3.2; phi += 0.31) {
      const Jacobi f = jacobi(elliptic_integral(phi, complement), complement);
      EXPECT_NEAR(f.sn, std::sin(phi), 1e-14) << "k'² " << complement << ", φ " << phi;
      EXPECT_NEAR(f.cn, std::cos(phi), 1e-14);
      EXPECT_NEAR(f.dn, std::hypot(std::cos(phi), std::sqrt(complement) * std::sin(phi)), 1e-14);
    }
  }
}

TEST(Elliptic, HaveTheirDerivatives) {
  // sn' = cn dn by a central difference: an error of δ²/6 |sn'''|, at most 4/6 δ², and of round-off over δ.
  const double delta = 1e-5;
  for (const double complement : {1.0, 0.3, 1e-4, 0.0})
    for (double u = -5; u < 5; u += 0.7) {
      const Jacobi f = jacobi(u, complement);
      EXPECT_NEAR((jacobi(u + delta, complement).sn - jacobi(u - delta, complement).sn) / (2 * delta),
                  f.cn * f.dn, 2e-10);
    }
}

TEST(Elliptic, AreCircularAndHyperbolicAtTheEnds) {
  EXPECT_NEAR(jacobi(0.7, 1).sn, std::sin(0.7), 1e-15);
  EXPECT_NEAR(jacobi(0.7, 0).sn, std::tanh(0.7), 1e-15);
  EXPECT_NEAR(jacobi(0.7, 1e-14).sn, std::tanh(0.7), 1e-13);
  EXPECT_TRUE(std::isinf(quarter_period(0)));
}

/// Euler's equations, I ω' = -ω × I ω, by the classical Runge-Kutta method of fourth order.
Vec3 integrate(const Vec3& I, Vec3 w, double time, int steps) {
  const auto rate = [&](const Vec3& omega) -> Vec3 {
    return -omega.cross(Vec3(I.cwiseProduct(omega))).cwiseQuotient(I);
  };
  const double h = time / steps;
  for (int n = 0; n < steps; ++n) {
    const Vec3 k1 = rate(w), k2 = rate(w + h / 2 * k1), k3 = rate(w + h / 2 * k2), k4 = rate(w + h * k3);
    w += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return w;
}

TEST(FreeTop, AgreesWithAnIntegration) {
  const Vec3 I(1, 2, 3);
  // Both sides of the separatrix, all signs, and the axes themselves.
  for (const Vec3& w : {Vec3(0.01, 1, 0.01), Vec3(-0.3, 1, 0.2), Vec3(0.3, -1, -0.2), Vec3(-0.01, -1, -0.9),
                        Vec3(0.8, 0.4, 0.1), Vec3(-0.8, 0.4, 0.1), Vec3(0.8, 0.4, -0.1), Vec3(0.5, 0, 0.5),
                        Vec3(1, 0, 0), Vec3(0, 0, -2), Vec3(0, 1, 0), Vec3(0, 1, 0.3), Vec3(0.3, 1, 0)}) {
    const FreeTop top(I, w);
    for (const double t : {0.0, 0.5, 3.0, 12.0})
      EXPECT_LE((top.omega(t) - integrate(I, w, t, 20'000)).norm(), 1e-10) << w.transpose() << ", t " << t;
  }
}

TEST(FreeTop, OnTheSeparatrixNeverComesBack) {
  const Vec3 I(1, 4, 6);
  for (const Vec3& w : {Vec3(2, 1, 1), Vec3(-2, 1, 1), Vec3(2, -1, -1), Vec3(-2, 1, -1)}) {
    const FreeTop top(I, w);
    EXPECT_TRUE(std::isinf(top.period()));
    EXPECT_LE((top.omega(2) - integrate(I, w, 2, 20'000)).norm(), 1e-10) << w.transpose();
  }
}

TEST(FreeTop, NearItsMiddleAxisTurnsOverAndBackIn391057Seconds) {
  const FreeTop top(Vec3(1, 2, 3), Vec3(0.01, 1, 0.01));
  EXPECT_NEAR(top.period(), 39.1057, 5e-5);
  EXPECT_LE((top.omega(top.period()) - Vec3(0.01, 1, 0.01)).norm(), 1e-11);
  EXPECT_LE((top.omega(top.period() / 2) - Vec3(-0.01, -1, 0.01)).norm(), 1e-11);
}

TEST(FreeTop, RefusesMomentsThatDoNotRise) {
  EXPECT_THROW(FreeTop(Vec3(2, 1, 3), Vec3::UnitX()), std::invalid_argument);
  EXPECT_THROW(FreeTop(Vec3(1, 2, 2), Vec3::UnitX()), std::invalid_argument);
  EXPECT_THROW(FreeTop(Vec3(0, 2, 3), Vec3::UnitX()), std::invalid_argument);
  EXPECT_THROW(FreeTop(Vec3(1, 2, 3), Vec3::Zero()), std::invalid_argument);
}

}  // namespace
}  // namespace spook::free_top_test
