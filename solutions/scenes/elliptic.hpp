#pragma once
// Jacobi's elliptic functions and Legendre's integral of the first kind, by arithmetic-geometric means.
//
//   F(φ) = ∫ dθ / √(1 - k² sin²θ) from 0 to φ;   φ = am(u) is its inverse;   sn = sin φ, cn = cos φ, dn = √(1 - k² sn²)
//
// Arguments are the complement k'² = 1 - k² in [0, 1], since 1 - k² would cancel digits near k = 1, the separatrix.
// k' = 0 is valid (hyperbolic functions); F(π/2) is then infinite.
//
// Source: Abramowitz and Stegun, 16.4 and 17.6.

namespace spook {

struct Jacobi {
  double sn, cn, dn;
};

/// Returns sn, cn and dn of `u` for k'² = `complement`.
Jacobi jacobi(double u, double complement);

/// Returns F(phi) [-] for k'² = `complement`.
double elliptic_integral(double phi, double complement);

/// Returns K = F(π/2): sn and cn have the period 4K, and dn has 2K.
double quarter_period(double complement);

}  // namespace spook
