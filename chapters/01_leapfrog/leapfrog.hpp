#pragma once
// Chapter 01 · Leapfrog: positions and velocities that take turns
//
// Newton's law, x' = v and m v' = f(x), in steps of h, with the velocity half a step off the position:
//
//   kick     v_{n+1/2} = v_{n-1/2} + h f(x_n) / m        Eq. (1.3)      notes (29), (35), and (15) put right
//   drift    x_{n+1}   = x_n + h v_{n+1/2}               Eq. (1.4)      notes (37)
//   start    v_{-1/2}  = v_0 - (h/2) f(x_0) / m          Eq. (1.5)      not in the notes
//
//   order four   parts of the lengths w h, …, w₀ h, …, w h, w₀ < 0; in each: drift, kick, drift
//                w = 1/(2N - ∛(2N)),  w₀ = 1 - 2N w       Eq. (1.11), (1.13)               not in the notes
//
//   x   position [m]        f   force [N]          1/m  inverse mass [1/kg]; with 0 no force changes v
//   v   velocity [m/s]      h   time step [s]
//
// The notes' (15) has h⁻¹ where h belongs: check its units.
#include <cstddef>
#include <functional>
#include <vector>

#include "common/types.hpp"

namespace spook {

/// Exercise 1.1. The velocity [m/s] after a force `f` [N] has acted for `h` [s]: Eq. (1.3); notes (29), (35). `h` may
/// have any sign; a negative one goes back in time.
Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h);

/// Exercise 1.2. The position [m] after moving for `h` [s] at velocity `v` [m/s]: Eq. (1.4); notes (37).
Vec3 drift(const Vec3& x, const Vec3& v, double h);

/// Exercise 1.3. Moves the velocity `v` [m/s] of time 0 half a step back, as leapfrog needs: Eq. (1.5). `f` [N] is the
/// force at time 0. `h` may have any sign.
Vec3 half_step_start(const Vec3& v, const Vec3& f, double inverse_mass, double h);

/// Point masses: x[i], v[i] and inverse_mass[i] belong to body i. `v` is half a step behind `x`.
struct Particles {
  std::vector<Vec3> x;               ///< positions at t_n [m]
  std::vector<Vec3> v;               ///< velocities at t_n - h/2 [m/s]
  std::vector<double> inverse_mass;  ///< [1/kg]
};

/// The force [N] on body i when the bodies are at x.
using ForceField = std::function<Vec3(std::size_t i, const std::vector<Vec3>& x)>;

/// Exercise 1.4. Makes a step of all bodies: all kicks, with forces at the old positions, then all drifts: Eq. (1.3),
/// (1.4). A body without a force keeps its velocity. Throws std::invalid_argument that names h if h is not positive and
/// finite: require_positive("h", h) of common/require.hpp.
void leapfrog_step(Particles& bodies, const ForceField& force, double h);

/// Exercise 1.5. Makes a step of order four: N parts of the length w h, one of w₀ h backwards in time, and N of w h
/// again: Eq. (1.11)-(1.13); not in the notes. Each part is half a drift, a whole kick, and half a drift. N is `pairs`. `v` belongs to the time of `x`, before and after,
/// so there is no half-step start. Throws std::invalid_argument that names h if h is not positive and finite, and one
/// that names pairs if pairs < 1: reject("pairs", pairs, "at least 1").
void composed_step(Particles& bodies, const ForceField& force, double h, int pairs);

}  // namespace spook
