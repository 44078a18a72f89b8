#pragma once
// Chapter 11 · The direct solver
//
// Forms S as a sparse matrix and factorises it: accurate to round-off, by a number of operations that is known
// beforehand. Bounds are treated by an interior-point method: each bound has a multiplier, its push, which
// keeps the row inside. At the end the push is zero unless the row is at that bound. A step takes one factorisation.
//
//   Schur complement   S = G M⁻¹ Gᵀ + Σ,  S_kl of rows that share no body is 0          Eq. (11.1)   notes (16)
//   saddle point       [M  Gᵀ; G  -Σ] [V; -λ] = [0; B]                                  Eq. (11.2)   notes, [1]
//   factors            P A Pᵀ = L D Lᵀ                                                  Eq. (11.3)   notes, "direct"
//   sound              |D_k| > 1e-14 (|A_kk| + Σ_j L_kj² |D_j|) for every pivot         Eq. (11.4)   not in the notes
//   pushes             S λ = B + z⁻ - z⁺,  s⁻ = λ - lo > 0,  s⁺ = hi - λ > 0            Eq. (11.5)   not in the notes
//   solved             s⁻ z⁻ = 0,  s⁺ z⁺ = 0                                            Eq. (11.6)   not in the notes
//   barrier            S̃ = S + z⁻/s⁻ + z⁺/s⁺, on the diagonal                           Eq. (11.7)   not in the notes
//   Newton's step      S̃ Δλ = B - S λ + τ⁻/s⁻ - τ⁺/s⁺,  towards s z = τ                 Eq. (11.8)   not in the notes
//                      Δz⁻ = (τ⁻ - z⁻ Δλ)/s⁻ - z⁻,  Δz⁺ = (τ⁺ + z⁺ Δλ)/s⁺ - z⁺          Eq. (11.9)   not in the notes
//   longest step       the largest part of it, up to 1, that keeps s >= 0 and z >= 0    Eq. (11.10)  not in the notes
//   target             trial step: τ = 0; real step: τ = (μ'/μ)³ μ - Δs Δz of the trial step;
//                      it is taken to (0.9 + 0.0999 α) α₂                               Eq. (11.11)  not in the notes
//   start              s z = E for every bound; λ nearest to 0 with rooms of at least
//                      min(√(E/S_kk), (hi - lo)/2)                                      Eq. (11.12)  not in the notes
//   round-off          1e-13 max |B| + 1e-14 max S_kk |λ_k|, the least residual         Eq. (11.13)  not in the notes
//   refined            S δ = B - G V - Σ λ,  then λ += δ and V += M⁻¹ Gᵀ δ              Eq. (11.14)  not in the notes
//
//   λ   impulses [N s]           M   mass matrix, one block a body    s   room to a bound [N s]
//   V   their velocity changes   Σ   regularisation [1/kg]            z   push of a bound [m/s]
//   P   an order for which L has few entries                          μ   mean of s z; μ' after the part α of a step
//   E   the largest of B²/S_kk + S_kk (λ₀² + λ_g²), an energy [J]
//
// Differs from the notes: the cost for a wire is O(N), not 1/N. Redundant and contradictory rows have a solution, too,
// if Σ > 0.
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "10_convergence/convergence.hpp"

namespace spook {

using SparseMatrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

/// Exercise 11.1. S as its lower triangle, diagonal included [1/kg]: Eq. (11.1); notes (16). Entry (k, l) belongs to
/// rows[k] and rows[l]. Two rows that share no dynamic body have no entry. The time is proportional to the number of
/// entries, not of pairs of rows.
template <int Dof>
SparseMatrix schur_complement(const std::vector<Row<Dof>>& rows);

/// Exercise 11.2. The matrix of Eq. (11.2), its lower triangle: first Dof unknowns for each body, then one for each
/// row. A static body has the identity for its M, and no entries of G. Other rigid bodies have three positive moments.
template <int Dof>
SparseMatrix saddle_matrix(const std::vector<Row<Dof>>& rows,
                           const std::vector<InverseMass<Dof>>& inverse_mass);

/// L, D and P of a matrix, and the pattern for which they were computed.
struct Factors {
  Eigen::SimplicialLDLT<SparseMatrix> ldlt;
  std::vector<int> columns, entries;  ///< pattern of the matrix, as in Eigen's compressed storage
  int analyses = 0;                   ///< number of symbolic analyses: of P and the pattern of L
};

/// Exercise 11.3. Factorises a symmetric matrix, given as its lower triangle, compressed: Eq. (11.3). Computes P and
/// the pattern of L only if the pattern of A differs from the last one; an entry of 0 belongs to the pattern. Returns
/// false, with useless factors, if a pivot fails Eq. (11.4) or is not finite.
bool factorise(const SparseMatrix& A, Factors& factors);

/// Exercise 11.4. Solves rows without bounds by the saddle point, Eq. (11.2): sets λ of the rows, and V, for any
/// initial values. Returns false if the factorisation fails; rows and V are then unchanged. With Σ = 0 it may fail for
/// rows that have a solution.
template <int Dof>
bool saddle_solve(std::vector<Row<Dof>>& rows, const std::vector<InverseMass<Dof>>& inverse_mass,
                  std::vector<Twist<Dof>>& V, Factors& factors);

/// Impulses strictly within their bounds: Eq. (11.5). Without a bound, its room is infinite and its push 0.
struct Interior {
  Vector lambda;            ///< [N s]
  Vector room_lo, room_hi;  ///< s⁻, s⁺ [N s]
  Vector push_lo, push_hi;  ///< z⁻, z⁺ [m/s]
};

/// Exercise 11.5. S̃, as its lower triangle with the pattern of S: Eq. (11.7).
SparseMatrix barrier_matrix(const SparseMatrix& S, const Interior& now);

/// The target of s z for each bound [N s m/s].
struct Target {
  Vector lo, hi;  ///< τ⁻, τ⁺
};

/// Exercise 11.6. The change of all five vectors towards `target`: Eq. (11.8), (11.9). `factors` are those of S̃.
/// Without a bound, room and push do not change.
Interior newton_step(const SparseMatrix& S, const Vector& B, const Interior& now, const Target& target,
                     const Factors& factors);

/// Exercise 11.7. The largest fraction of a step, at most 1, that keeps all rooms and pushes >= 0: Eq. (11.10).
double longest_step(const Interior& now, const Interior& step);

/// Exercise 11.8. The starting point: Eq. (11.12). λ₀ is the value nearest to 0 within the bounds, and λ_g the value
/// nearest to `guess`. The guess gives the size of the impulses, not their values. If E is 0, no size is known: then E
/// is 1 J.
Interior interior_start(const SparseMatrix& S, const Vector& B, const Vector& lo, const Vector& hi,
                        const Vector& guess);

/// Exercise 11.9. The next point, by two Newton steps with `factors`, those of S̃: Eq. (11.11). The fraction (0.9 +
/// 0.0999 α) α₂ of the second step is taken, or all of it if no bound limits it, α₂ = 1. α and α₂ are the longest
/// fractions of the two steps, Eq. (11.10). Then the smallest of |λ|, s⁻ and s⁺ of each row determines the other two.
Interior interior_step(const SparseMatrix& S, const Vector& B, const Vector& lo, const Vector& hi,
                       const Interior& now, const Factors& factors);

/// Round-off residual of S λ = B, as a velocity [m/s]: Eq. (11.13). Given.
inline double roundings(const SparseMatrix& S, const Vector& B, const Vector& lambda) {
  return 1e-13 * B.cwiseAbs().maxCoeff() +
         1e-14 * Vector(S.diagonal()).cwiseProduct(lambda).cwiseAbs().maxCoeff();
}

/// Exercise 11.10. Solves S λ = B within lo and hi, lo < hi: from interior_start by interior_step, until the residual,
/// Eq. (4.8), is at most `stop.tolerance` or the round-off of Eq. (11.13). On entry `lambda` is a guess of the
/// impulses' size, or zero. On return it is the best λ found, within the bounds; if the first factorisation fails, or
/// every residual is NaN, it is the clamped guess. The history has the residual after each factorisation, at most
/// stop.max_sweeps. If these do not suffice, or a factorisation fails, the report has not converged, and `trouble`
/// gives the reason. Without rows there is no factorisation, and the report has converged. Throws
/// std::invalid_argument, naming max_sweeps or tolerance, as solve does, with rows or without.
SolveReport interior_solve(const SparseMatrix& S, const Vector& B, const Vector& lo, const Vector& hi,
                           const StopRule& stop, Vector& lambda, Factors& factors);

/// Exercise 11.11. Solves S λ = B within the bounds of the rows, from scratch; sets λ of the rows, and V. First solves
/// without bounds. If all λ are within their bounds, refines them by Eq. (11.14). If this λ, clamped, solves the rows,
/// one factorisation suffices. Otherwise calls interior_solve, with that λ as its guess. If that fails, chapter 04's
/// solve continues from there, and `trouble` gives the reason. interior_solve may make stop.max_sweeps factorisations,
/// and then solve may make as many sweeps. A row with lo = hi has that λ. The history has the residual of Eq. (4.8)
/// after each factorisation [m/s], and the result of each sweep. Throws as solve does.
template <int Dof>
SolveReport direct_solve(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V, const StopRule& stop,
                         Factors& factors);

}  // namespace spook
