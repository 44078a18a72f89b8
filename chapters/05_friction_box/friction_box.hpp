#pragma once
// Chapter 05 · The friction box
//
// A contact gets two more rows, one along each tangent, against sliding. They hold a velocity at zero, not a gap, and
// their impulse has a bound that is known before the solve:
//
//   tangents     n = t1 × t2                                              Eq. (5.1)    notes, before (42)
//   target       u·t1 = 0, u·t2 = 0                                       Eq. (5.2)    notes (40), (41)
//   row          (t·Kt + Γ) λ = -u·t - u_f·t,  that is a = 0, b = 1       Eq. (5.3)    not in the notes
//   softness     Γ = 1/(h c)                                              Eq. (5.4)    not in the notes
//   mass         m = 1/((1/m_i + 1/m_j) N)                                Eq. (5.6)    notes, after (44)
//   bound        Λ = μ m g_n h                                            Eq. (5.7)    notes (43), (44), but for h
//   box          -Λ <= λ1 <= Λ,  -Λ <= λ2 <= Λ                            Eq. (5.8)    notes (43), (44)
//
//   u     velocity of j's contact point relative to i's [m/s]     μ     friction coefficient
//   u_f   change of u by the forces of this step [m/s]            g_n   gravity along the normal, |g·n| [m/s²]
//   K     collision matrix of Eq. (3.8) [1/kg]                    N     contacts between the two bodies
//   c     viscosity [N s/m]: F/c is the creep under a force F     h     step [s]
//
// Differs from the notes: λ is an impulse, so the bound has h; a, b and Γ are friction's own, not the contact's; g_n
// in place of g, so that it is right on a slope, too.
#include <array>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

/// Two unit vectors that are perpendicular to a normal and to each other.
struct Tangents {
  Vec3 t1, t2;
};

/// Exercise 5.1. Tangents with t1 × t2 = n, up to round-off, for any unit vector `n`: Eq. (5.1); notes, before (42).
/// There are many such pairs, and any of them will do.
Tangents tangents(const Vec3& n);

/// Exercise 5.2. The a, b and Σ of a friction row: 0, 1, and Γ of Eq. (5.4); not in the notes.
/// Throws std::invalid_argument, naming the parameter, unless h [s] is positive and finite, and c [N s/m] is
/// positive; c may be infinite, and Γ is then 0.
SpookParameters friction_parameters(double h, double c);

/// Exercise 5.3. The mass that stands in for the load on one contact [kg]: Eq. (5.6); notes, after (44). Takes the
/// inverse masses of both bodies [1/kg], of which one may be 0 (it is fixed), and N, the number of contacts between
/// them. Throws std::invalid_argument that names inverse_mass_i or inverse_mass_j if it is negative or not finite,
/// inverse_mass_j if both are 0, and contacts if it is < 1.
double representative_mass(double inverse_mass_i, double inverse_mass_j, int contacts);

/// Exercise 5.4. The largest impulse of one friction row [N s]: Eq. (5.7); notes (43), (44), where h is missing. Throws
/// std::invalid_argument, naming the parameter, unless mu, mass [kg] and normal_gravity [m/s²] are >= 0, and h [s] > 0,
/// all finite.
double friction_bound(double mu, double mass, double normal_gravity, double h);

/// Exercise 5.5. The two friction constraints of a contact, along t1 and t2 in this order, with bounds ±`bound` [N s]
/// and the numbers of `spook`: Eq. (5.2), (5.3), (5.8); notes (42)-(44). A bound of 0 is allowed: such a contact has no
/// friction. Their gap is 0. Nothing is checked.
template <int Dof>
std::array<Constraint<Dof>, 2> friction_constraints(const Contact& contact, const Tangents& tangents,
                                                    double bound, const SpookParameters& spook);

/// Exercise 5.6. The friction impulse J = λ1 t1 + λ2 t2 [N s] of one contact alone, + on j and - on i: Eq. (5.3) for
/// each tangent separately, as if t1·K t2 were 0, then (5.8).
///   K        collision matrix [1/kg]
///   u        relative velocity at the contact; it contains u_f, the change by the forces of this step [m/s]
///   Gamma    softness Γ [1/kg]
///   bound    Λ [N s]
Vec3 friction_impulse(const Mat3& K, const Vec3& u, const Tangents& tangents, double Gamma, double bound);

/// Exercise 5.7. Adds friction to the step of chapter 04: unless mu is 0, the row of each contact is followed by
/// those of its two tangents, Eq. (5.3)-(5.8). N is the number of contacts with the same i and j; g_n is |gravity ·
/// n|. Returns the report of solve. Throws std::invalid_argument as step_contacts, friction_parameters and
/// friction_bound do, without changing anything.
SolveReport step_friction(Simulation& simulation, const std::vector<Contact>& contacts, double h);

}  // namespace spook
