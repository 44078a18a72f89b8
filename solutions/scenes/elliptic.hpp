#pragma once
// Jacobi's elliptic functions and Legendre's integral of the first kind, by arithmetic-geometric means.
//
//   F(φ) = ∫ dθ / √(1 - k² sin²θ) from 0 to φ;   φ = am(u) is its inverse;   sn = sin φ, cn = cos φ, dn = √(1 - k² sn²)
//
// The modulus is given by its complement, k'² = 1 - k² in [0, 1]: near k = 1, the separatrix, k² has lost the digits
// that matter. k' = 0 itself is fine (hyperbolic functions), and F(π/2) is then infinite.
//
// Source: Abramowitz and Stegun, 16.4 and 17.6.

namespace spook {

struct Jacobi {
  double sn, cn, dn;
};

/// sn, cn and dn of `u`, k'² = `complement`.
Jacobi jacobi(double u, double complement);

/// F(phi) [-], k'² = `complement`.
double elliptic_integral(double phi, double complement);

/// F(π/2): sn and cn have the period 4K, dn 2K.
double quarter_period(double complement);

}  // namespace spook
