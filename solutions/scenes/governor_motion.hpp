#pragma once
// A flyball governor in two angles, independent of the engine. Two balls hang on arms from the top of a spindle. Links
// from the middles of the arms carry a sleeve. A link is half as long as an arm, so the sleeve is at the balls' height.
//
//   I = I₀ + 2 (J + M l² sin²θ),   P = 2 (J + M l²) + m l² sin²θ       θ of the arms from hanging down
//   energy        ½ I φ'² + ½ P θ'² - (2M + m) g l cos θ               φ of the spindle
//   φ' = L/I                                                           without a torque, L is constant
//   P θ'' = 2 M l² sin θ cos θ φ'² - m l² sin θ cos θ θ'² - (2M + m) g l sin θ
//   steady        cos θ = (1 + m/(2M)) g/(l φ'²)                       θ'' = θ' = 0
//
//   M, J    mass of a ball, and its moment about its centre            I₀   moment of spindle and sleeve about the spindle
//   m       mass of the sleeve                                         l    length of an arm, which is massless
//
// From the energy, by Lagrange's equations. Without a sleeve, m = 0, the steady motion is that of a conical pendulum.
#include <cmath>

#include <Eigen/Core>

namespace spook {

struct Governor {
  double l;        ///< [m]
  double M, J, m;  ///< [kg, kg m², kg]
  double I0;       ///< [kg m²]
  double g;        ///< [m/s²]

  using State = Eigen::Vector3d;  ///< θ, θ', φ [rad, rad/s, rad]

  /// The moment of inertia I at the angle θ [kg m²].
  double moment(double theta) const {
    const double across = l * std::sin(theta);
    return I0 + 2 * (J + M * across * across);
  }

  State rate(const State& y, double L) const {
    const double sin = std::sin(y[0]), cos = std::cos(y[0]), turning = L / moment(y[0]);
    const double P = 2 * (J + M * l * l) + m * l * l * sin * sin;
    const double outward = l * l * cos * (2 * M * turning * turning - m * y[1] * y[1]);
    return {y[1], sin * (outward - (2 * M + m) * g * l) / P, turning};
  }

  double energy(const State& y, double L) const {
    const double sin = std::sin(y[0]), P = 2 * (J + M * l * l) + m * l * l * sin * sin;
    return L * L / (2 * moment(y[0])) + P * y[1] * y[1] / 2 - (2 * M + m) * g * l * std::cos(y[0]);
  }

  /// The angular velocity φ' at which the arms stay at θ [rad/s].
  double steady(double theta) const { return std::sqrt((1 + m / (2 * M)) * g / (l * std::cos(theta))); }
};

}  // namespace spook
