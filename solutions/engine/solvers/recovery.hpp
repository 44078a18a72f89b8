#pragma once
// Recovery: an overlap moves its bodies apart, and leaves them no speed. A joint beyond its limit moves back, and a
// rope that is too long shortens, in the same way.
//
//   u = G (W + W_f + V)            speed at which a contact opens after the solve [m/s]; -a g if an overlap was at rest
//   λ > 0 and u > 0                the contact recovers: its impulse is larger than the one that stops the bodies
//   S λ' = -G (W + W_f)            its island is solved once more, with closed contacts that stop and do not recover:
//                                  a = 0, b = 1 and Σ = 0, all else as before                              Eq. (7.17)
//   x += h (W + W_f + V)           positions move with the first solution, the overlap shrinks by the part a h
//   W <- W + W_f + V'              velocities go on with the second: a plastic impact
//
// In the second solve the motor of an exceeded limit does not aim at the speed of the return, Eq. (13.17), but at its
// own, or at 0 if its own is towards the limit.
//
// Which rows of joints recover is in engine/constraints/joint_recovery.hpp. A position that moves with one velocity and
// goes on with another changes the angular momentum a little.
//
// With Σ = 0 the impulses at the corners of a box are not unique. So Σ is at most a thousandth of S_kk instead, which
// leaves a thousandth of the speed of approach, inwards.
#include <functional>
#include <vector>

#include "engine/constraints/joint_recovery.hpp"
#include "engine/solvers/solver.hpp"

namespace spook {

/// The numbers of a row that a second solve changes.
struct RowState {
  double B, Sigma, diagonal, lo, hi, lambda;
};

/// Numbers of the first solve that the second one needs. Their memory serves all steps, since new memory for a large
/// pile costs as much as many sweeps.
struct FirstSolve {
  std::vector<RowState> rows;  ///< for restore()
  /// The rows of each island that has a row with another B in the second solve.
  std::vector<std::vector<int>> changed;
};

/// Turns the rows of the solved system `s` into those of the second solve; λ stays that of the first. Returns false,
/// and changes nothing, where no contact that pushes opens faster than `ignored` [m/s], and no joint recovers.
/// `may_throw` says which contacts are springs, whose rebound stays; null: none. `first` receives what the next two
/// functions take.
template <int Dof>
bool prepare_second_solve(const SolverInput<Dof>& s, double ignored,
                          const std::function<bool(const Contact&)>& may_throw, const JointRecovery& joints,
                          FirstSolve& first);

/// Shortens the velocities V of the second solve `s` in those islands of contacts where they add energy. Contacts that
/// stop and do not bounce take energy, so such a solve has failed: with friction on overlapping bodies the problem may
/// have no solution. `changed` are the rows of each island that was solved again. Islands of joints, whose rows are the
/// first `joint_rows`, and of springs are left as they are.
template <int Dof>
void limit_energy(const SolverInput<Dof>& s, std::size_t joint_rows,
                  const std::vector<std::vector<int>>& changed,
                  const std::function<bool(const Contact&)>& may_throw);

/// Gives the rows the states that prepare_second_solve has found.
template <int Dof>
void restore(const std::vector<RowState>& before, std::vector<Row<Dof>>& rows);

}  // namespace spook
