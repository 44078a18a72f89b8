#pragma once
// Chapter 09 · Better friction: limits from what presses, and the cone
//
// The box of chapter 05 guesses the normal force from a mass, and favours two directions. Here the limit follows the
// normal impulse, the tangents may follow the sliding, and the box becomes a disc: Coulomb's cone.
//
//   rows of a contact   k: normal, k + 1: along t1, k + 2: along t2
//   two-pass limit      Λ = μ λ_n,  λ_n from a solve without friction     Eq. (9.1)   notes, "normal forces as limits"
//   sliding tangents    t1 = u_t/|u_t|,  t2 = n × t1                      Eq. (9.2)   notes, "tangential velocities"
//   cone                |λ_t| <= μ λ_n,  λ_t = (λ_1, λ_2)                 Eq. (9.3)   notes (3)
//   onto a disc         λ_t min(1, Λ/|λ_t|)                               Eq. (9.4)   not in the notes
//   stiffest direction  s = (S11 + S22)/2 + √(((S11 - S22)/2)² + S12²)    Eq. (9.5)   not in the notes
//   update              λ_t <- onto a disc of μ λ_n (λ_t + r_t/s)         Eq. (9.6)   not in the notes
//   residual            s |Eq. (9.6) - λ_t| for tangents, else Eq. (4.8)  Eq. (9.7)   not in the notes
//
//   u   velocity of j's contact point relative to i's, what the forces of this step add included [m/s]
//   u_t its part across n: the slip                    S11, S12, S22   of the two tangential rows [1/kg]
//   Λ   limit of the friction impulse [N s]            r_t             what these two lack, Eq. (4.6) [m/s]
//
// Differs from the notes: their scaled box is chapter 05's. With the limits of Eq. (9.3) friction depends on what it
// changes; no energy falls with every update, nothing promises that the sweeps converge. The residual tells.
#include "08_pairs/pairs.hpp"

namespace spook {

/// Where the three rows of a contact with friction are, and how rough it is.
struct FrictionContact {
  std::size_t normal;  ///< its row; the next two are those of t1 and t2
  double mu;           ///< μ >= 0
};

/// Two impulses along the tangents [N s].
using Vec2 = Eigen::Vector2d;

/// Exercise 9.1. Tangents with t1 along the slip of `u` [m/s] across the unit vector `n`, and t1 × t2 = n, to a few
/// roundings: Eq. (9.2); notes, "Alternative friction models". Where the slip is at most `slow` [m/s], it has no
/// direction worth following: then any that chapter 05 allows, Eq. (5.1).
Tangents sliding_tangents(const Vec3& n, const Vec3& u, double slow);

/// Exercise 9.2. Sets the bounds of the friction rows to ±μ times the λ that their normal row has now: Eq. (9.1). Their
/// own λ stays as it is, even outside.
template <int Dof>
void limit_friction(const std::vector<FrictionContact>& contacts, std::vector<Row<Dof>>& rows);

/// Exercise 9.3. Two passes: first without friction (its rows have bounds and λ of 0), then with the limits of Eq.
/// (9.1), from where the first ended. All other rows begin with the λ that they bring. Each pass has the whole stop
/// rule; the history has both. Converged if the second pass is. Throws as solve does. V as in solve: what friction rows
/// bring in λ must leave V, too, before the first pass.
template <int Dof>
SolveReport two_pass_solve(const std::vector<FrictionContact>& contacts, std::vector<Row<Dof>>& rows,
                           std::vector<Twist<Dof>>& V, const StopRule& stop);

/// Exercise 9.4. The point of the disc |λ_t| <= radius that is nearest: Eq. (9.4). Zero for a radius of 0.
Vec2 onto_disc(const Vec2& lambda, double radius);

/// Exercise 9.5. Brings the two friction rows of a contact up to date, with μ times the normal impulse of now for a
/// radius: Eq. (9.5), (9.6). Their bounds `lo` and `hi` are neither looked at nor set. Returns s |Δλ_t| [m/s].
template <int Dof>
double update_friction(const FrictionContact& contact, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V);

/// Exercise 9.6. One sweep: every row in order by Eq. (4.7), but the two friction rows of a contact together by Eq.
/// (9.6), right after its normal row. `contacts` come in the order of their rows. Returns the largest S_kk |Δλ_k|
/// or s |Δλ_t| [m/s].
template <int Dof>
double sweep_on_cones(const std::vector<FrictionContact>& contacts, std::vector<Row<Dof>>& rows,
                      std::vector<Twist<Dof>>& V);

/// Exercise 9.7. Residual with the cones: the largest of Eq. (9.7) [m/s]. Each row, or pair, is compared
/// with its own update from this λ and V. Changes nothing.
template <int Dof>
double residual_on_cones(const std::vector<FrictionContact>& contacts, const std::vector<Row<Dof>>& rows,
                         const std::vector<Twist<Dof>>& V);

/// Exercise 9.8. Sweeps on cones until one returns at most `stop.tolerance`, or there were `stop.max_sweeps`: Eq.
/// (9.6), (4.9). Contract of solve(), of which V, what is thrown, and the history are part.
template <int Dof>
SolveReport cone_solve(const std::vector<FrictionContact>& contacts, std::vector<Row<Dof>>& rows,
                       std::vector<Twist<Dof>>& V, const StopRule& stop);

}  // namespace spook
