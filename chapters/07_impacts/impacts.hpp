#pragma once
// Chapter 07 · Impacts: Newton's restitution with Coulomb's friction
//
// Impacts are resolved before the rows are built, pair by pair, with one impulse for each impact.
//
//   velocity     u = G (W + W_f/2), at the contact, at t_n                        Eq. (7.1)    not in the notes
//   target       u'·n = -e u·n,  and u'_t = 0 if it sticks                        Eq. (7.2)    notes (1), (2)
//   stick        J = K⁻¹ (u' - u)                                                 Eq. (7.3)    notes, before (3)
//   cone         |J_t| <= μ J_n                                                   Eq. (7.4)    notes (3)
//   slide        J_n = -(1+e) u·n / (n·K(n - μt)),  J = J_n n - μ J_n t           Eq. (7.5)    notes (4), (5)
//   work         ΔE = J·(u + ½ K J)                                               Eq. (7.6)    not in the notes
//   safe         J = (1+e) P + κ (Q - P)                                          Eq. (7.7)    not in the notes
//                P = -u·n/(n·Kn) n,  Q = -K⁻¹ u
//   κ            the largest in [0, 1] with J inside the cone                     Eq. (7.8)    not in the notes
//   apply        W_i -= M⁻¹ (J, r_i×J),  W_j += M⁻¹ (J, r_j×J)                    Eq. (7.9)    notes (6), (7)
//   threshold    an impact if u·n < -threshold                                    Eq. (7.10)   not in the notes
//
//   u, u'   velocity of j's contact point relative to i's, before and after [m/s] t   direction of the slip, u_t/|u_t|
//   e   restitution, 0 to 1                                                      μ   friction coefficient
//   K   collision matrix of Eq. (3.8) [1/kg]                                     J   impulse [N s], + on j, - on i
//
// Differs from the notes: (4) is used only if its denominator is positive. An impulse of the notes that would add
// energy is replaced by Eq. (7.7), which never does. An impact ignores joints: it models a free pair, and the engine
// adds the joints, Eq. (7.19).
#include <optional>
#include <vector>

#include "06_distance/distance.hpp"

namespace spook {

/// Exercise 7.1. The impulse after which the contact has u' = -e (u·n) n: Eq. (7.2), (7.3); notes (1), (2). K is
/// regular.
Vec3 stick_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e);

/// Exercise 7.2. Tells whether an impulse does not pull (J_n >= 0), and lies inside the friction cone about n or on its
/// surface: Eq. (7.4); notes (3). True for J = 0.
bool inside_cone(const Vec3& J, const Vec3& n, double mu);

/// Exercise 7.3. The impulse on the surface of the cone, against the slip before the impact: Eq. (7.5); notes (4), (5).
/// If |u_t| <= 1e-12 |u|, the slip is only round-off: then t = 0, and the impulse is along n. Returns nothing if n·K(n - μt) is not
/// positive: then no such impulse stops the approach.
std::optional<Vec3> sliding_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e, double mu);

/// Exercise 7.4. Energy that an impulse adds to its two bodies [J]: Eq. (7.6); not in the notes.
double impact_work(const Mat3& K, const Vec3& u, const Vec3& J);

/// Exercise 7.5. An impulse that has the restitution e, is inside the cone, and adds no energy for 0 <= e <= 1,
/// whatever K, for bodies that approach each other (u·n < 0): Eq. (7.7), (7.8); not in the notes.
Vec3 safe_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e, double mu);

/// Exercise 7.6. The impulse of an impact. Zero for u·n >= 0. Otherwise Eq. (7.3), or (7.5) if (7.3) is outside the
/// cone. If there is no (7.5), or if the impulse adds energy, (7.6) > 0, it is (7.7) instead. Notes (1)-(5).
Vec3 impact_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e, double mu);

/// Exercise 7.7. Adds the velocity changes of the impulse J [N s] at a contact to its two bodies, in `motion.W`:
/// Eq. (7.9); notes (6), (7). A point mass has no angular part.
template <int Dof>
void apply_impact(const Contact& contact, const Vec3& J, Motion<Dof>& motion);

/// Laws of impact.
struct ImpactLaw {
  double restitution = 0;   ///< e, 0 to 1
  double friction = 0;      ///< μ >= 0
  double threshold = 1e-9;  ///< smallest approach speed of an impact [m/s], >= 0; above round-off
  int max_passes = 100;     ///< over all contacts
};

struct ImpactReport {
  int impacts = 0;
  int passes = 0;  ///< with the last one, which finds no impact unless max_passes ended it; 0 without contacts
  double energy = 0;  ///< energy added by the impacts, with u of Eq. (7.1) [J]; negative if lost
};

/// Exercise 7.8. Goes through all contacts in order, whatever their gap. Resolves each impact at once, with u of (7.1),
/// so that the next contact has the new velocities. Repeats this until a pass finds no approach faster than the
/// threshold, Eq. (7.10), or max_passes are done. Notes, "Resolve high velocity impacts". Throws std::invalid_argument
/// that names the parameter, even without contacts, unless 0 <= restitution <= 1, friction and threshold are finite and
/// >= 0, and max_passes >= 1.
template <int Dof>
ImpactReport resolve_impacts(const std::vector<Contact>& contacts, const ImpactLaw& law, Motion<Dof>& motion);

/// Exercise 7.9. Adds impacts to the step of chapter 06. They come first, if restitution is not 0: Eq.
/// (7.1)-(7.10). Their friction is mu. Their threshold is |gravity| h, the change of speed by gravity in a step.
/// Returns what step_joints returns. Throws std::invalid_argument as resolve_impacts and step_joints do; for an h
/// that is not positive, before anything has changed.
SolveReport step_impacts(Simulation& simulation, const std::vector<Contact>& contacts, double h);

}  // namespace spook
