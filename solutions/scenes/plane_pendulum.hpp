#pragma once
// The closed form of the plane pendulum, θ'' = -ω² sin θ from rest at θ0; θ = 0 hangs down.
//
//   sin(θ/2) = κ cd(ωt),   cos(θ/2) = κ'/dn(ωt),   κ = sin(θ0/2),   κ' = cos(θ0/2),   cd = cn/dn
//   period     4 K(κ)/ω                                                                     Eq. (6.13)
//
// Derivation: the energy gives (θ'/2)² = ω² (κ² - sin²(θ/2)). So y = sin(θ/2)/κ satisfies y'² = ω² (1 - y²)(1 - κ² y²),
// the equation of sn. It starts at y = 1, a quarter period after sn: y = sn(ωt + K) = cd(ωt). The cosine follows by
// 1 - κ² cd² = κ'²/dn²; this form cancels no digits where θ is near 180°.
//
// Source: Landau and Lifshitz, Mechanics, § 11; Abramowitz and Stegun, 16.8.

namespace spook {

class PlanePendulum {
 public:
  /// A pendulum that starts at rest at `angle0`, |angle0| < π [rad]. `rate` is ω [1/s]; with 0 it stays there.
  PlanePendulum(double angle0, double rate);

  struct Direction {
    double sin, cos;  ///< of θ
  };

  Direction direction(double t) const;

  /// The period [s]; infinite for a rate of 0.
  double period() const;

 private:
  double sin_half_, cos_half_;  // κ and κ'
  double rate_;
};

}  // namespace spook
