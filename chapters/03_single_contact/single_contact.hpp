#pragma once
// Chapter 03 · A single contact: SPOOK for one row
//
// A contact between bodies i and j keeps its gap g >= 0; it may push, never pull. SPOOK's impulse λ satisfies
//
//   (G M⁻¹ Gᵀ + Σ) λ = -a g - b G W - h G M⁻¹ f                                  Eq. (3.7)   notes (8), (26)
//
//   g   signed gap, (x_j + r_j - x_i - r_i)·n [m]; negative when penetrating     Eq. (3.1)   notes (21)
//   n   unit normal, from body i to body j
//   r   from a body's centre of mass to the contact point [m]
//   G   Jacobian, dg/dt = G W                                                    Eq. (3.3)   notes (25)
//   W   generalised velocity: v and ω of each body, ω in world coordinates       notes (13)
//   λ   impulse [N s], + on j and - on i
//   a, b, Σ   from the step h [s], the stiffness k [N/m], and the relaxation d [steps]:
//
//   a = 4/(h(1+4d))    b = 4d/(1+4d)    Σ = 4/(h² k (1+4d))                      Eq. (3.4)-(3.6)   notes (9)-(11)
//
//   step   λ from W and W_f = h M⁻¹ f;  W <- W + M⁻¹ Gᵀ λ;  then the step of chapter 02   Eq. (3.10)-(3.12)
//
//   K   collision matrix, the inverse mass at the contact point [1/kg]; G M⁻¹ Gᵀ is n·Kn  Eq. (3.8), (3.9)
//
// Differs from the notes: the right-hand side has -a times the signed gap, where they have G q or a positive depth. K
// is an inverse mass everywhere.
#include "02_quaternions/quaternions.hpp"
#include "common/types.hpp"

namespace spook {

struct SpookParameters {
  double a;      ///< weight of the gap [1/s]
  double b;      ///< weight of the velocity [-]
  double Sigma;  ///< regularisation [1/kg]
};

/// Exercise 3.1. The three numbers of SPOOK: Eq. (3.4)-(3.6); notes (9)-(11). Throws std::invalid_argument that names
/// the parameter, unless h > 0, k > 0 and d >= 0, all finite: see common/require.hpp.
SpookParameters spook_parameters(double h, double k, double d);

/// A touching or nearly touching pair of bodies. Vectors are in world coordinates. Functions do not check a Contact.
struct Contact {
  int i, j;    ///< body indices, i ≠ j
  Vec3 n;      ///< unit normal from i to j
  double gap;  ///< signed [m]
  Vec3 r_i;    ///< contact point minus the centre of i [m]
  Vec3 r_j;    ///< contact point minus the centre of j [m]
};

/// The two blocks of a Jacobian row, linear part first.
struct ContactJacobian {
  Twist<6> Gi, Gj;
};

/// Exercise 3.2. G with G W = rate of the gap [m/s]: Eq. (3.3); notes (25).
ContactJacobian contact_jacobian(const Contact& contact);

/// The inverse mass matrix of one body: a number for a point mass, a number and a matrix for a rigid body. All zero
/// is a static body.
template <int Dof>
struct InverseMass;

template <>
struct InverseMass<3> {
  double linear = 0;  ///< 1/m [1/kg]
  Twist<3> times(const Twist<3>& G) const { return linear * G; }
};

template <>
struct InverseMass<6> {
  double linear = 0;            ///< 1/m [1/kg]
  Mat3 angular = Mat3::Zero();  ///< I⁻¹ in world coordinates [1/(kg m²)]
  Twist<6> times(const Twist<6>& G) const { return twist(linear * G.head<3>(), angular * G.tail<3>()); }
};

/// Exercise 3.3. K [1/kg]: an impulse J at the contact, + on j and - on i, changes the relative velocity of the two
/// contact points by K J. Eq. (3.8); the K of the notes' (26).
Mat3 collision_matrix(const InverseMass<6>& body_i, const Vec3& r_i, const InverseMass<6>& body_j,
                      const Vec3& r_j);

/// Exercise 3.4. The impulse λ >= 0 [N s] of one frictionless contact: Eq. (3.10), (3.11); notes (26), (32).
///   nKn               n·Kn [1/kg]
///   gap               signed [m]; an open contact pushes, too, if the numerator of (3.10) is positive
///   normal_velocity   G W, relative velocity along n before the step [m/s]; negative when approaching
///   force_velocity    h G M⁻¹ f, its change by the forces of this step [m/s]; for a sphere on a floor -h 9.81 m/s²
double contact_impulse(const SpookParameters& spook, double nKn, double gap, double normal_velocity,
                       double force_velocity);

/// Helpers for the steps: W, M⁻¹ and W_f = h M⁻¹ f of a body, and W <- W + V.
inline Twist<6> twist_of(const RigidBody& body) {
  return twist(body.v, body.omega);
}
inline InverseMass<6> inverse_mass_of(const RigidBody& body) {
  if (body.mass == 0) return {};
  if (body.principal == Vec3::Zero()) return {.linear = 1 / body.mass};
  return {.linear = 1 / body.mass, .angular = world_inertia(body.q, body.principal.cwiseInverse())};
}
inline Twist<6> force_twist_of(const RigidBody& body, const Vec3& gravity, double h) {
  return twist(body.mass == 0 ? Vec3::Zero() : Vec3(h * gravity), Vec3::Zero());
}
inline void add_twist(RigidBody& body, const Twist<6>& V) {
  body.v += V.head<3>();
  body.omega += V.tail<3>();
}

/// Exercise 3.5. Steps bodies of which two touch at the given contact. The impulse of the contact changes the
/// velocities of both, then all bodies move as in step_free: Eq. (3.3), (3.8), (3.10), (3.11), (2.11). k and d are
/// the simulation's. Throws std::invalid_argument as spook_parameters does, without changing anything.
void step_touching(Simulation& simulation, const Contact& contact, double h);

}  // namespace spook
