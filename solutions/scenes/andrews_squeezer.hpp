#pragma once
// Andrews' squeezer: seven bodies in a plane, driven by a torque against a spring, with one degree of freedom. The
// published equations, in seven angles with six closure conditions; independent of the engine.
//
//   M(q) q'' + Gᵀ μ = f(q, q'),   G q'' = -(dG/dt) q'                index 1
//
//   q = β, Θ, γ, Φ, δ, Ω, ε   angles [rad]; the orientations of the bodies are β, β + Θ, γ, δ + Φ, δ, Ω + ε, ε
//
// Source: E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, VII.7; F. Mazzia and C. Magherini, Test Set
// for Initial Value Problem Solvers, University of Bari: the problem "andrews", parameters and solution at 0.03 s.
#include <array>

#include <Eigen/Dense>

#include "common/types.hpp"

namespace spook::squeezer {

using Angles = Eigen::Matrix<double, 7, 1>;
using State = Eigen::Matrix<double, 14, 1>;  ///< q, q'

inline constexpr double xa = -0.06934, ya = -0.00227, xb = -0.03635, yb = 0.03273, xc = 0.014,
                        yc = 0.072;  // [m]
inline constexpr double d = 0.028, da = 0.0115, e = 0.02, ea = 0.01421, rr = 0.007, ra = 0.00092, ss = 0.035;
inline constexpr double sa = 0.01874, sb = 0.01043, sc = 0.018, sd = 0.02, ta = 0.02308, tb = 0.00916, u = 0.04;
inline constexpr double ua = 0.01228, ub = 0.00449, zf = 0.02, zt = 0.04, fa = 0.01421;  // [m]
inline constexpr double c0 = 4530, l0 = 0.07785;  // stiffness and rest length of the spring [N/m, m]
inline constexpr double drive = 0.033;            // torque [N m]
inline constexpr std::array<double, 7> mass = {0.04325, 0.00365, 0.02373, 0.00706,
                                               0.07050, 0.00706, 0.05498};  // [kg]
inline constexpr std::array<double, 7> inertia = {2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7,
                                                  1.169e-5, 5.667e-7, 1.912e-5};  // [kg m²]

/// The start at rest, with closed loops; the given β determines all other angles.
Angles start();

/// The orientations of the bodies in the plane [rad].
Angles of_bodies(const Angles& q);

/// The centres of mass of the bodies, with z = 0.
std::array<Vec3, 7> centres(const Angles& q);

/// The force of the spring on point D of body 3, in the world [N]; and D in the world [m], from the angle of body 3.
Vec3 spring_end(double gamma);
Vec3 spring_force(const Vec3& D);

State rate(const State& y);

/// Closure errors of the loops [m].
Eigen::Matrix<double, 6, 1> closure(const Angles& q);

/// The nearest state with closed loops, in positions and velocities.
State projected(const State& y);

}  // namespace spook::squeezer
