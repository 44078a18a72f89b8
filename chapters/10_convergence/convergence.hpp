#pragma once
// Chapter 10 · Convergence
//
// The same rows, solved in fewer sweeps: begin where the last step ended; go through the rows in a better order, or in
// a random one; go along conjugate directions.
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
//   energy           E = ½ λ·Sλ - B·λ, which no part of it increases               Eq. (10.9)   not in the notes
//   relaxed          B = -G W - G W_f,  Σ = 0,  once positions have moved          Eq. (10.15)  not in the notes
//
//   r   what the rows lack [m/s], Eq. (4.6)      free   a row between its bounds, lo < λ < hi
//   e   what sweep() returns [m/s]               z', r'   those of the iteration before
//
// Differs from the notes: conjugate gradients are projected in two places, Eq. (10.8) and the sweeps between them.
#include <random>

#include "09_better_friction/better_friction.hpp"

namespace spook {

/// A contact as it was in the last step.
struct OldContact {
  int i, j;    ///< body indices
  Vec3 point;  ///< in the world, relative to body j's centre [m]
};

/// Exercise 10.1. For each contact the index of the old one that it continues, or -1: Eq. (10.1). They are of the
/// same pair (i, j), in this order, and their points at most `reach` [m] apart. Of all that could be joined, the two
/// that are nearest to each other come first, then the nearest two of those that are left, and so on: no old contact
/// is continued twice.
std::vector<int> match_contacts(const std::vector<Contact>& contacts, const std::vector<OldContact>& old,
                                double reach);

/// Exercise 10.2. Begins the rows with these impulses [N s], each clamped to its row's bounds, and makes V what
/// they do: Eq. (10.2); notes, "warm starting". V is assigned, whatever it held.
/// Throws std::invalid_argument, naming impulses, unless there is one a row.
template <int Dof>
void warm_start(const std::vector<double>& impulses, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V);

/// Exercise 10.3. The indices of `heights` [m] from the lowest to the highest; equal ones stay in order: Eq.
/// (10.3). A NaN is higher than any, ∞ as well.
std::vector<int> order_along(const std::vector<double>& heights);

/// Exercise 10.4. The indices 0 to n - 1 in an order that is random, each of the n! as likely: Eq. (10.4). n >= 0.
/// The generator goes on: the next call gives another order.
std::vector<int> random_order(int n, std::mt19937_64& generator);

/// Exercise 10.5. One sweep in that order, which has every row once; returns what sweep() does: Eq. (4.9).
template <int Dof>
double sweep_in_order(const std::vector<int>& order, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V);

/// Exercise 10.6. The factor by which the entries of a history shrink, over its second half: Eq. (10.5).
/// NaN for fewer than two entries, or when one of the two that count, e_m and e_n, is not positive.
double observed_rate(const std::vector<double>& history);

/// Exercise 10.7. z of Eq. (10.6) [N s]: what a sweep over the free rows, first to last, and one last to first make
/// of S z = r from z = 0, without bounds. Rows that are not free have z = 0, whatever their r. `bodies`: how many
/// there are. Neither λ nor B nor the bounds of a row matter.
template <int Dof>
std::vector<double> precondition(const std::vector<Row<Dof>>& rows, const std::vector<double>& r,
                                 const std::vector<bool>& free, std::size_t bodies);

/// Exercise 10.8. Projected and preconditioned conjugate gradients: Eq. (10.6)-(10.9); notes, "conjugate gradient".
/// An iteration begins with a sweep, Eq. (4.7), which puts rows on and off their bounds, if it is the first; if the
/// step before was projected; or if a row at a bound lacks more, Eq. (4.8), than every free one. Elsewhere a sweep
/// would spoil the directions. Then comes the stop rule, and then a step of the free rows.
/// Contract of solve(): V, the stop rule (max_sweeps counts iterations), what is thrown. The history has one entry an
/// iteration: what its sweep returned, or, where there was none, the residual of Eq. (4.8).
template <int Dof>
SolveReport conjugate_solve(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V, const StopRule& stop);

/// Exercise 10.9. The second solve of a relaxed substep, which finds the velocities to keep: Eq. (10.15). Positions have
/// moved by those of the first. Sweeps the rows as if they were rigid, a = 0, b = 1 and Σ = 0, from the λ and V that the
/// first solve left. Of the rows only λ changes. `motion` is that of which they were made. For contacts, friction and
/// joints: the target of a motor would be lost. Contract of solve(): V, the stop rule, what is thrown.
template <int Dof>
SolveReport relax(const Motion<Dof>& motion, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V,
                  const StopRule& stop);

}  // namespace spook
