#pragma once
// Chapter 09 · Better friction: limits from normal forces, and the cone
//
// The box of chapter 05 estimates the normal force from a mass, and favours two directions. Here the limit follows the
// normal impulse, tangents may follow the slip, and the box becomes a disc: Coulomb's cone.
//
//   rows of a contact   k: normal, k + 1: along t1, k + 2: along t2
//   two-pass limit      Λ = μ λ_n,  λ_n from a solve without friction     Eq. (9.1)   notes, "normal forces as limits"
//   sliding tangents    t1 = u_t/|u_t|,  t2 = n × t1                      Eq. (9.2)   notes, "tangential velocities"
//   cone                |λ_t| <= μ λ_n,  λ_t = (λ_1, λ_2)                 Eq. (9.3)   notes (3)
//   onto a disc         λ_t min(1, Λ/|λ_t|)                               Eq. (9.4)   not in the notes
//   common divisor      s = (S11 + S22)/2 + √(((S11 - S22)/2)² + S12²)    Eq. (9.5)   not in the notes
//   update              λ_t <- (λ_t + r_t/s) onto a disc of μ λ_n         Eq. (9.6)   not in the notes
//   residual            s |Eq. (9.6) - λ_t| for tangents, else Eq. (4.8)  Eq. (9.7)   not in the notes
//
//   step                impacts and rows: step_rows; any solver; then finish_step
//
//   u   velocity of j's contact point relative to i's, with the change by this step's forces [m/s]
//   u_t tangential part of u: the slip                 S11, S12, S22   of the two friction rows [1/kg]
//   Λ   limit of the friction impulse [N s]            r_t             residuals of the friction rows, Eq. (4.6) [m/s]
//
// Differs from the notes: their scaled box is chapter 05's. With the limits of Eq. (9.3), friction depends on the
// normal impulses that it changes. There is no energy that every update lowers, so the sweeps need not converge. The
// residual shows whether they have.
#include "08_pairs/pairs.hpp"

namespace spook {

/// The three rows of a contact with friction, and its friction coefficient.
struct FrictionContact {
  std::size_t normal;  ///< index of the normal row; the next two rows are those of t1 and t2
  double mu;           ///< μ >= 0
};

/// Two impulses along the tangents [N s].
using Vec2 = Eigen::Vector2d;

/// Exercise 9.1. Tangents with t1 along the slip, the part of `u` [m/s] perpendicular to the unit vector `n`, and t1 ×
/// t2 = n, to a few rounding errors: Eq. (9.2); notes, "Alternative friction models". If the slip is at most `slow`
/// [m/s], its direction is meaningless: then any tangents of chapter 05, Eq. (5.1).
Tangents sliding_tangents(const Vec3& n, const Vec3& u, double slow);

/// Exercise 9.2. Sets the bounds of the friction rows to ±μ times the current λ of their normal row: Eq. (9.1). Their
/// own λ does not change, even if it is outside.
template <int Dof>
void limit_friction(const std::vector<FrictionContact>& contacts, std::vector<Row<Dof>>& rows);

/// Exercise 9.3. Solves in two passes. The first is without friction: friction rows have bounds and λ of 0. The second
/// has the limits of Eq. (9.1), and starts from the result of the first. All other rows start from their current λ.
/// Each pass may make stop.max_sweeps sweeps, and the history has the sweeps of both. Converged if the second pass is.
/// Throws as solve does. V as in solve: before the first pass the initial λ of friction rows are removed from V.
template <int Dof>
SolveReport two_pass_solve(const std::vector<FrictionContact>& contacts, std::vector<Row<Dof>>& rows,
                           std::vector<Twist<Dof>>& V, const StopRule& stop);

/// Exercise 9.4. The nearest point of the disc |λ_t| <= radius: Eq. (9.4). Zero for a radius of 0.
Vec2 onto_disc(const Vec2& lambda, double radius);

/// Exercise 9.5. Updates the two friction rows of a contact; the radius is μ times the current normal impulse: Eq.
/// (9.5), (9.6). Neither reads nor sets their bounds `lo` and `hi`. Returns s |Δλ_t| [m/s].
template <int Dof>
double update_friction(const FrictionContact& contact, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V);

/// Exercise 9.6. Makes a sweep: updates every row in order by Eq. (4.7), but the two friction rows of a contact
/// together by Eq. (9.6), right after its normal row. `contacts` are in the order of their rows. Returns the largest
/// S_kk |Δλ_k| or s |Δλ_t| [m/s].
template <int Dof>
double sweep_on_cones(const std::vector<FrictionContact>& contacts, std::vector<Row<Dof>>& rows,
                      std::vector<Twist<Dof>>& V);

/// Exercise 9.7. The residual with the cones: the largest of Eq. (9.7) [m/s]. Compares each row, or pair of friction
/// rows, with its own update from this λ and V. Changes nothing.
template <int Dof>
double residual_on_cones(const std::vector<FrictionContact>& contacts, const std::vector<Row<Dof>>& rows,
                         const std::vector<Twist<Dof>>& V);

/// Exercise 9.8. Sweeps on cones until a sweep returns at most `stop.tolerance`, or `stop.max_sweeps` are done: Eq.
/// (9.6), (4.9). V, exceptions and history follow the contract of solve().
template <int Dof>
SolveReport cone_solve(const std::vector<FrictionContact>& contacts, std::vector<Row<Dof>>& rows,
                       std::vector<Twist<Dof>>& V, const StopRule& stop);

/// The rows of a step, ready for any solver.
struct StepRows {
  Motion<6> motion;                       ///< from which the rows were built: after the impacts
  std::vector<Row<6>> rows;               ///< of the joints, then of each contact: normal, t1, t2
  std::vector<FrictionContact> friction;  ///< places of the contacts in `rows`, with μ; empty if mu is 0
};

/// Exercise 9.9. The first half of a step, up to the solver: resolves the impacts as step_impacts does, then builds
/// the rows of step_joints, in the same order and with the same bounds, Eq. (5.7). Changes velocities by the impacts
/// only. Lists where each contact with friction is, for Eq. (9.1) and (9.3). Throws std::invalid_argument as
/// step_impacts does, but does not look at max_sweeps and tolerance.
StepRows step_rows(Simulation& simulation, const std::vector<Contact>& contacts, double h);

/// The second half of a step, after the solver. Given. Adds V to the velocities, then moves all bodies.
inline void finish_step(Simulation& simulation, const std::vector<Twist<6>>& V, double h) {
  for (std::size_t b = 0; b < V.size(); ++b) add_twist(simulation.bodies[b], V[b]);
  step_free(simulation, h);
}

}  // namespace spook
