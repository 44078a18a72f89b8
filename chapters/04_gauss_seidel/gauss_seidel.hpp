#pragma once
// Chapter 04 · Many contacts: projected Gauss-Seidel
//
// Solves   S λ = B,   lo <= λ <= hi,   S = G M⁻¹ Gᵀ + Σ,   without forming S. The effect of all λ so far is stored as a
// velocity change of each body, V = M⁻¹ Gᵀ λ: every update scatters into V, and the next one gathers from it.
//
//   diagonal     S_kk = Gi·M⁻¹Gi + Gj·M⁻¹Gj + Σ              Eq. (4.3)    notes (16), (26)
//   right side   B = -a g - b G W - G W_f                    Eq. (4.4)    notes (8), (26), (28)
//   scatter      V_i += M⁻¹Gi Δλ,  V_j += M⁻¹Gj Δλ           Eq. (4.5)    notes (33), (34)
//   gather       r = B - Gi·V_i - Gj·V_j - Σ λ               Eq. (4.6)    notes (28)
//   update       λ <- clamp(λ + r/S_kk, lo, hi)              Eq. (4.7)    notes (31), (32)
//   residual     max_k S_kk |clamp(λ + r/S_kk) - λ|          Eq. (4.8)    not in the notes
//   stop         max_k S_kk |Δλ_k| <= tolerance in a sweep   Eq. (4.9)    not in the notes
//
//   step         rows, solve, W <- W + V, then the step of chapter 02
//
//   G   Jacobian row, blocks Gi, Gj on bodies i, j        λ     impulse [N s], between lo and hi
//   V   velocity change of each body so far               W_f   velocity change by this step's forces: h M⁻¹ f
//   r   residual of a row [m/s]                           Σ     regularisation [1/kg]
//
// Differs from the notes: bounds may be two-sided, λ may start at values other than 0, and Eq. (4.8) measures how far
// the rows have converged.
#include <limits>
#include <string>
#include <vector>

#include "03_single_contact/single_contact.hpp"

namespace spook {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// The velocities of all bodies at the start of a step; entry i belongs to body i.
template <int Dof>
struct Motion {
  std::vector<InverseMass<Dof>> inverse_mass;
  std::vector<Twist<Dof>> W;   ///< velocity [m/s, rad/s]
  std::vector<Twist<Dof>> Wf;  ///< velocity change by the forces of this step, h M⁻¹ f [m/s, rad/s]
};

/// A scalar constraint, independent of masses and velocities.
template <int Dof>
struct Constraint {
  int i, j;               ///< body indices, i ≠ j
  Twist<Dof> Gi, Gj;      ///< Jacobian blocks
  double gap;             ///< signed violation g [m]
  SpookParameters spook;  ///< a, b, Σ
  double lo = 0;          ///< bounds on λ [N s]: 0 and infinity for a contact
  double hi = infinity;
};

/// A row of S λ = B, ready for sweeps.
template <int Dof>
struct Row {
  int i, j;                   ///< body indices, i ≠ j
  Twist<Dof> Gi, Gj;          ///< Jacobian blocks
  Twist<Dof> MinvGi, MinvGj;  ///< M⁻¹ Giᵀ, M⁻¹ Gjᵀ
  double B;                   ///< right side [m/s]
  double Sigma;               ///< regularisation [1/kg]
  double diagonal;            ///< S_kk [1/kg]
  double lo, hi;              ///< bounds on λ [N s]
  double lambda = 0;          ///< impulse so far [N s]
};

/// Exercise 4.1. Computes the numbers of a row that are constant during sweeps: Eq. (4.3), (4.4); notes (26), (28). Its
/// λ is 0.
template <int Dof>
Row<Dof> make_row(const Constraint<Dof>& constraint, const Motion<Dof>& motion);

/// Exercise 4.2. Adds the velocity change of an impulse `delta` [N s] along the row to its two bodies: Eq. (4.5);
/// notes (33), (34). The row's own λ is not touched.
template <int Dof>
void apply_impulse(const Row<Dof>& row, double delta, std::vector<Twist<Dof>>& V);

/// Exercise 4.3. Updates one row and scatters its change: Eq. (4.6), (4.7); notes (28), (31)-(34). Returns Δλ [N s],
/// the change after projection on [lo, hi].
template <int Dof>
double update_row(Row<Dof>& row, std::vector<Twist<Dof>>& V);

/// Exercise 4.4. Updates every row once, in order; each update uses the results of those before it: Eq. (4.2); notes
/// (18)-(20). Returns the largest S_kk |Δλ_k| [m/s]: Eq. (4.9).
template <int Dof>
double sweep(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V);

/// Exercise 4.5. Residual of S λ = B with bounds, as a velocity [m/s]: Eq. (4.8). It is zero at a solution, and only
/// there. A row at lo with r <= 0, or at hi with r >= 0, contributes 0. Changes nothing.
template <int Dof>
double residual(const std::vector<Row<Dof>>& rows, const std::vector<Twist<Dof>>& V);

/// The stop rule: a solver stops when either limit is reached.
struct StopRule {
  int max_sweeps = 50;
  double tolerance = 0;  ///< for the result of sweep() [m/s]
};

struct SolveReport {
  std::vector<double> history;  ///< result of each sweep [m/s]; the size is the number of sweeps
  bool converged = false;       ///< the last sweep was at or below the tolerance
  std::string trouble = {};     ///< why a later chapter's solver fell back to sweeps; empty if it did not
};

/// Exercise 4.6. Sweeps until a sweep returns at most `stop.tolerance`, which may be 0, or `stop.max_sweeps` are done:
/// Eq. (4.9). With no rows: no sweep, converged. `V` must hold M⁻¹ Gᵀ λ of the rows' λ on entry (zero for λ = 0), and
/// does so on return. Throws std::invalid_argument that names max_sweeps if it is < 1, or tolerance if it is negative
/// or not finite, even if there are no rows.
template <int Dof>
SolveReport solve(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V, const StopRule& stop);

/// Helper for the steps: input of the rows, with W at t_n - h/2 and inertias at t_n.
inline Motion<6> motion_of(const Simulation& simulation, double h) {
  Motion<6> motion;
  for (const RigidBody& body : simulation.bodies) {
    motion.inverse_mass.push_back(inverse_mass_of(body));
    motion.W.push_back(twist_of(body));
    motion.Wf.push_back(force_twist_of(body, simulation.gravity, h));
  }
  return motion;
}

/// Exercise 4.7. Steps bodies with any number of contacts. Builds a row for each contact, in order, solves all rows
/// together, adds V to the velocities, then moves all bodies: Eq. (4.4), (4.7), (2.11). Returns the report of solve.
/// Throws std::invalid_argument as spook_parameters and solve do, without changing anything.
SolveReport step_contacts(Simulation& simulation, const std::vector<Contact>& contacts, double h);

}  // namespace spook
