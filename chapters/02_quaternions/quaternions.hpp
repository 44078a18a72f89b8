#pragma once
// Chapter 02 · Quaternions: how a body turns
//
// q = (w, x, y, z), |q| = 1, turns body coordinates into world coordinates. ω is in world coordinates.
//
//   rate            q' = ½ ω q,  with ω as the quaternion (0, ω)                      Eq. (2.3)    notes (38), (39)
//   first order     q_{n+1} = normalise(q_n + (h/2) ω_{n+1} q_n)                      Eq. (2.4)    notes (38)
//   exponential     q_{n+1} = (cos θ/2, sin(θ/2) ω/|ω|) q_n,  θ = h |ω|               Eq. (2.6)    not in the notes
//   inertia         I_world = R(q) diag(I1, I2, I3) R(q)ᵀ                             Eq. (2.7)    notes, under (7)
//   gyroscopic      τ_gyro = -ω × (I_world ω)                                         Eq. (2.9)    not in the notes
//   free rotation   q -> q (cos α/2, sin(α/2) e_c),  α = t L_c / I_c           Eq. (2.10), (2.11)     not in the notes
//
//   step            kick v, drift x, then turn q: for each body by itself   Eq. (1.3), (1.4), (2.6), (2.11)
//
//   ω   angular velocity [rad/s]    I1, I2, I3   principal moments [kg m²], along the body's own axes e_1, e_2, e_3
//   h   time step [s], of any sign  L = I ω      angular momentum [kg m²/s]
//
// Differs from the notes: (38) there uses the old ω together with the new v of (37). And their (36) changes ω by
// torques only, without (2.9): then a free body keeps ω, while a real one keeps L.
#include "01_leapfrog/leapfrog.hpp"
#include "common/simulation.hpp"
#include "common/types.hpp"

namespace spook {

/// Exercise 2.1. dq/dt [1/s] of orientation `q` at angular velocity `omega` [rad/s, world]: Eq. (2.3); notes (38).
/// Not a unit quaternion.
Quat quaternion_rate(const Quat& q, const Vec3& omega);

/// Exercise 2.2. The notes' update: a step of `h` [s] along the rate, then normalised: Eq. (2.4). Turns by 2
/// atan(h|ω|/2) instead of h|ω|: Eq. (2.5).
Quat update_first_order(const Quat& q, const Vec3& omega, double h);

/// Exercise 2.3. Turns by h|ω| about ω, exactly, then normalises: Eq. (2.6). Also exact for ω = 0 and for the smallest
/// ω.
Quat update_exponential(const Quat& q, const Vec3& omega, double h);

/// Exercise 2.4. Inertia in world coordinates from the three principal moments: Eq. (2.7). With inverse moments [1/(kg
/// m²)] instead, the same formula gives the inverse inertia in world coordinates.
Mat3 world_inertia(const Quat& q, const Vec3& principal);

/// Exercise 2.5. The gyroscopic torque τ_gyro [N m]: with I ω' = τ + τ_gyro the angular momentum changes by dL/dt = τ,
/// Eq. (2.9). `inertia` is in world coordinates, like ω.
Vec3 gyroscopic_torque(const Mat3& inertia, const Vec3& omega);

/// Exercise 2.6. Torque-free motion for `h` [s]: five turns about body axes with L fixed in the world, Eq. (2.11).
/// Second order, reversible, and L = I ω kept up to round-off. Changes `q` and `omega` [rad/s, world].
void free_rotation(Quat& q, Vec3& omega, const Vec3& principal, double h);

/// Exercise 2.7. Steps bodies without contacts, as the first step of your own engine. Each body is kicked by its weight
/// and drifts, Eq. (1.3), (1.4). It turns by Eq. (2.6) if its three moments are equal, otherwise by Eq. (2.11). A point
/// mass does not turn, and a static body does not move. Joints and contacts come in later chapters. Throws
/// std::invalid_argument that names h unless h is positive and finite.
void step_free(Simulation& simulation, double h);

}  // namespace spook
