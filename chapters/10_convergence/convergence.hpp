#pragma once
// Chapter 10 · Convergence
//
// The same rows, solved in fewer sweeps: by a start from the last step's impulses, by a better or a random order of
// rows, and by conjugate directions.
//
//   same contact     the nearest of the same pair, within a reach                  Eq. (10.1)   not in the notes
//   warm start       λ <- clamp(old λ),  V = M⁻¹ Gᵀ λ                              Eq. (10.2)   notes, "warm starting"
//   along gravity    rows by the height of their point, from the ground up         Eq. (10.3)   notes, "gravity"
//   at random        every order as likely as every other                          Eq. (10.4)   notes, "randomize"
//   rate             ρ = (e_n / e_m)^(1/(n-m)),  m = ⌈n/2⌉                         Eq. (10.5)   not in the notes
//   preconditioner   z: one sweep forth and one back on S z = r, free rows only    Eq. (10.6)   notes, "(CG)"
//   direction        p = z + β p,  β = z·r / z'·r';  z alone after a sweep         Eq. (10.7)   notes, "(CG)"
//   step             d = clamp(λ + α p) - λ,  α = p·r / p·Sp;
//                    λ += t d,  t = d·r / d·Sd, but within [0, 1]                  Eq. (10.8)   not in the notes
//   energy           E = ½ λ·Sλ - B·λ: no sweep and no step increases it           Eq. (10.9)   not in the notes
//   relaxed          B = -G W - G W_f,  Σ = 0,  once positions have moved          Eq. (10.15)  not in the notes
//   gap in between   g <- g + h G W                                                Eq. (10.19)  not in the notes
//   soft numbers     a,  σ = S/(S + Σ),  1 - σ  by frequency and damping ratio     Eq. (10.20)  not in the notes
//   soft update      Δλ = σ (w - G W)/S - (1 - σ) λ,  w = -a g;  open: w = -g/h    Eq. (10.21)  not in the notes
//
//   r   residuals of the rows [m/s], Eq. (4.6)   free   a row between its bounds, lo < λ < hi
//   e   result of sweep() [m/s]                  z', r'   z and r of the iteration before
//
// Differs from the notes: in conjugate gradients impulses are projected in two places: in steps, Eq. (10.8), and in
// sweeps between steps.
#include <random>

#include "09_better_friction/better_friction.hpp"

namespace spook {

/// A contact as it was in the last step.
struct OldContact {
  int i, j;    ///< body indices
  Vec3 point;  ///< in the world, relative to body j's centre [m]
};

/// Exercise 10.1. Returns for each contact the index of the old contact that it continues, or -1: Eq. (10.1). Both have
/// the same pair (i, j), in this order, and points at most `reach` [m] apart. Matches the closest two of all candidates
/// first, then the closest two of the rest, and so on, so that no old contact is continued twice.
std::vector<int> match_contacts(const std::vector<Contact>& contacts, const std::vector<OldContact>& old,
                                double reach);

/// Exercise 10.2. Sets each λ to its impulse [N s], clamped to the row's bounds, and V to M⁻¹ Gᵀ λ: Eq. (10.2); notes,
/// "warm starting". Overwrites V. Throws std::invalid_argument, naming impulses, unless there is one for each row.
template <int Dof>
void warm_start(const std::vector<double>& impulses, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V);

/// Exercise 10.3. The indices of `heights` [m] from the lowest to the highest; equal heights keep their order: Eq.
/// (10.3). NaN is above all numbers, ∞ included.
std::vector<int> order_along(const std::vector<double>& heights);

/// Exercise 10.4. The indices 0 to n - 1 in random order, with equal probability for each of the n! orders: Eq. (10.4).
/// n >= 0. Advances the generator, so the next call returns another order.
std::vector<int> random_order(int n, std::mt19937_64& generator);

/// Exercise 10.5. Makes a sweep in that order, which contains every row once; returns the same as sweep(): Eq. (4.9).
template <int Dof>
double sweep_in_order(const std::vector<int>& order, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V);

/// Exercise 10.6. The factor by which the entries of a history shrink, over its second half: Eq. (10.5). NaN for fewer
/// than two entries, or if e_m or e_n is not positive.
double observed_rate(const std::vector<double>& history);

/// Exercise 10.7. z of Eq. (10.6) [N s]: the result of two sweeps on S z = r from z = 0, without bounds, over the free
/// rows, first to last and then last to first. Rows that are not free have z = 0, for any r. `bodies`: the number of
/// bodies. λ, B and the bounds of rows are not used.
template <int Dof>
std::vector<double> precondition(const std::vector<Row<Dof>>& rows, const std::vector<double>& r,
                                 const std::vector<bool>& free, std::size_t bodies);

/// Exercise 10.8. Projected and preconditioned conjugate gradients: Eq. (10.6)-(10.9); notes, "conjugate gradient". An
/// iteration starts with a sweep, Eq. (4.7), which moves rows on and off their bounds, in three cases: if it is the
/// first iteration; if the step before was projected; or if a row at a bound has a larger residual, Eq. (4.8), than
/// every free row. In other iterations there is no sweep, since it would destroy conjugacy. Every iteration then checks
/// the stop rule, and if it is not met, the free rows make a step. Contract of solve(): V, the stop rule (max_sweeps
/// counts iterations), exceptions. The history has one entry per iteration: the result of its sweep, or without a sweep
/// the residual of Eq. (4.8).
template <int Dof>
SolveReport conjugate_solve(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V, const StopRule& stop);

/// Exercise 10.9. Solves the rows a second time, for the velocities that a relaxed substep keeps: Eq. (10.15).
/// Positions have already moved with the velocities of the first solve. Sweeps the rows as rigid ones, with a = 0,
/// b = 1 and Σ = 0, from the λ and V of the first solve. Changes only λ in the rows. `motion` is the one that the
/// rows were built from. Valid for contacts, friction and joints; the target of a motor would be lost. V, the stop
/// rule and the exceptions are as in solve().
template <int Dof>
SolveReport relax(const Motion<Dof>& motion, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V,
                  const StopRule& stop);

/// The numbers of a soft row, as today's engines store them; by default, those of a rigid row.
struct SoftParameters {
  double bias_rate = 0;      ///< a: speed that closes a gap, per gap [1/s]
  double mass_scale = 1;     ///< σ = S/(S + Σ)
  double impulse_scale = 0;  ///< Σ/(S + Σ)
};

/// Exercise 10.10. Returns the numbers of a soft row in a substep of `h` [s], by the frequency [Hz] of its undamped
/// oscillation and its damping ratio ζ: Eq. (10.20). Keeps the digits of the smaller scale, too, for very stiff and
/// very soft rows. Throws std::invalid_argument that names h or frequency if it is not positive and finite, and damping
/// if it is negative or not finite.
SoftParameters soft_parameters(double h, double frequency, double damping);

/// Exercise 10.11. Updates a soft row in a substep of `h` [s], h > 0: Eq. (10.21), then (4.7). `gap` [m or rad] is
/// that of the row. A row with lo = 0 only pushes. If its gap is open, that is above 0, the row is rigid, whatever
/// `soft` says, and lets the gap close within the substep. W are the velocities of the bodies [m/s, rad/s], with all
/// impulses and forces so far. Neither reads nor sets B, Σ and diagonal of the row. Returns Δλ [N s].
template <int Dof>
double update_soft_row(double h, const SoftParameters& soft, double gap, Row<Dof>& row,
                       std::vector<Twist<Dof>>& W);

/// Exercise 10.12. Makes a soft substep of `h` [s]: Eq. (10.15), (10.19), (10.21). Adds forces W_f and the λ of the
/// substep before to W, sweeps the rows as soft ones, moves the gaps, and sweeps the same rows as rigid ones. Returns
/// the W between the two sweeps, with which the positions of the bodies are to move. `gaps` [m or rad] has one number
/// for each row; `Wf` and W have one velocity for each body [m/s, rad/s]. Throws std::invalid_argument that names h if
/// it is not positive and finite, and gaps if there is not one for each row.
template <int Dof>
std::vector<Twist<Dof>> soft_substep(double h, const SoftParameters& soft, const std::vector<Twist<Dof>>& Wf,
                                     std::vector<Row<Dof>>& rows, std::vector<double>& gaps,
                                     std::vector<Twist<Dof>>& W);

}  // namespace spook
