#pragma once
// The closed form of Euler's equations: ω of a torque-free body, in its own axes.
//
// With axes a, b, c such that b has the middle moment, and c is the axis that L circles about (3 when L² > 2T I2, else 1):
//
//   ω_a = ± A cn u,   ω_b = ± B sn u,   ω_c = ± C dn u,      u = ω_p t + u_0
//
//   A² = P/(a(c-a)),  B² = P/(b(c-b)),  C² = Q/(c(c-a)),   ω_p² = (c-b) Q/(abc),   k'² = (c-a)(L² - 2T b)/((c-b) Q)
//   P = 2T c - L²,    Q = L² - 2T a                        with a, b, c for the moments, too
//
// Source: Landau and Lifshitz, Mechanics, § 37.
#include "common/types.hpp"

namespace spook {

class FreeTop {
 public:
  /// Throws std::invalid_argument unless the `principal` moments rise, I1 < I2 < I3 [kg m²], and `omega` [rad/s] is not
  /// zero.
  FreeTop(const Vec3& principal, const Vec3& omega);

  /// ω at time t [rad/s].
  Vec3 omega(double t) const;

  /// The period of ω in the body's axes [s]; infinite on the separatrix.
  double period() const;

 private:
  int a_, c_;                 // the axes of cn and dn; the axis of sn is 1
  Vec3 amplitude_;            // amplitude of ω along each axis, with its sign [rad/s]
  double rate_, complement_;  // ω_p [1/s] and k'²
  double u0_;
};

}  // namespace spook
