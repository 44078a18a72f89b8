#pragma once
// Chapter 14 · Rows for a machine
//
// The same rows, solved faster. The three rows of a contact are one block. Constraint pairs of one colour share no
// dynamic body, so they can be updated in parallel: four in the lanes of one instruction, and several packs on threads.
//
//   block of a contact   S_cc = G M⁻¹ Gᵀ + Σ,  3 x 3                                    Eq. (14.1)    not in the notes
//   right-hand side      q = r + S_cc λ                                                 Eq. (14.2)    not in the notes
//   separating           q_n <= 0:  λ = 0                                               Eq. (14.3)    notes (31)
//   sticking             S_cc λ = q  within |λ_t| <= μ λ_n                              Eq. (14.4)    notes (3)
//   sliding              (S_cc + diag(0, α, α)) λ = q,  |λ_t| = μ λ_n,  α > 0           Eq. (14.5)    not in the notes
//   colour of a pair     the smallest that neither body has yet                         Eq. (14.7)    not in the notes
//   number of colours    <= 2 Δ - 1,  Δ the most pairs on a body                        Eq. (14.8)    not in the notes
//   lanes                Eq. (4.6), (4.7) in each, Δλ = 0 in an empty lane              Eq. (14.9)    not in the notes
//   discs in lanes       λ_t m,  m = 1 where |λ_t| <= Λ, else Λ/|λ_t|                   Eq. (14.14)   not in the notes
//
//   r   residual of the three rows, Eq. (4.6) [m/s]       α   slip over friction [1/kg]
//
// The physics is unchanged: a solver of this chapter has the same solution as that of chapter 04 or 09.
#include <array>

#include "10_convergence/convergence.hpp"

namespace spook {

/// Exercise 14.1. The impulses (λ_n, λ_1, λ_2) [N s] of a single contact on Coulomb's cone: Eq. (14.3)-(14.6). `S` is
/// symmetric and positive definite [1/kg], `q` is the right-hand side of Eq. (14.2) [m/s], and `mu` is at least 0 and
/// finite. The result satisfies λ_n >= 0 exactly, and lies at most a few rounding errors outside the cone. With a NaN in
/// q it contains a NaN, also for q_n <= 0.
Vec3 solve_on_cone(const Mat3& S, const Vec3& q, double mu);

/// Exercise 14.2. Updates the three rows of a contact at once: Eq. (14.1), (14.2), then Eq. (14.3)-(14.6). Neither
/// reads nor sets the rows' bounds. Returns |S_cc Δλ| [m/s].
template <int Dof>
double update_contact(const FrictionContact& contact, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V);

/// Exercise 14.3. Returns a colour 0, 1, 2 ... for each pair of bodies, such that two pairs of one colour share no
/// dynamic body: Eq. (14.7). A static body is -1 here. Pairs get their colours in the order of the list; a body may be
/// in any number of pairs. `bodies`: the number of bodies.
std::vector<int> colour_pairs(const std::vector<Pair>& pairs, std::size_t bodies);

/// Number of lanes.
inline constexpr int lane_count = 4;

/// One number in each lane.
using Lanes = Eigen::Array<double, lane_count, 1>;

/// A velocity or a Jacobian block in each lane: column d holds component d for all lanes.
template <int Dof>
using LaneTwists = Eigen::Array<double, lane_count, Dof>;

/// One row in each lane, each of a different pair of bodies. Default: all lanes empty, that is zeros, and a diagonal of
/// 1.
template <int Dof>
struct LaneRows {
  LaneTwists<Dof> Gi = LaneTwists<Dof>::Zero(), Gj = Gi, MinvGi = Gi, MinvGj = Gi;
  Lanes B = Lanes::Zero(), Sigma = B, diagonal = Lanes::Ones(), lo = B, hi = B, lambda = B;
};

/// Four pairs of bodies that share no dynamic body. rows[0] has the first row of each of the four pairs, rows[1] the
/// second one of each, and so on.
template <int Dof>
struct Pack {
  std::array<int, lane_count> i = {-1, -1, -1, -1}, j = i;  ///< -1: a static body, or an empty lane
  std::array<int, lane_count> first = i;  ///< index of each lane's first row in the packed list; -1: none
  std::vector<LaneRows<Dof>> rows;
  std::vector<Lanes> mu = {};  ///< of each three rows, if these are a contact with friction; otherwise empty
};

/// Exercise 14.4. Updates all rows of a pack in their order: Eq. (14.9), that is Eq. (4.6), (4.7) in each lane. A body
/// of index -1 has velocity 0, and nothing is written for it. Returns the largest S_kk |Δλ_k| [m/s].
template <int Dof>
double update_pack(Pack<Dof>& pack, std::vector<Twist<Dof>>& V);

/// Packs that share no dynamic body.
template <int Dof>
using Colour = std::vector<Pack<Dof>>;

/// Packs all rows by colour, using colour_pairs(). Given. Consecutive rows of the same two bodies stay together and
/// keep their order. The rows of `contacts` are in packs of their own, with μ. `bodies`: the number of bodies.
template <int Dof>
std::vector<Colour<Dof>> packed(const std::vector<Row<Dof>>& rows, std::size_t bodies,
                                const std::vector<FrictionContact>& contacts = {});

/// Copies the λ of packs back to the rows that were packed. Given.
template <int Dof>
void unpack(const std::vector<Colour<Dof>>& colours, std::vector<Row<Dof>>& rows);

/// Calls work(0), work(1) ... work(threads - 1) at the same time, in rounds. Given. When all calls have returned, calls
/// `next` once, and starts another round if `next` returns true. An exception of a call is thrown at the end of its
/// round. With one thread, all work runs on the calling thread.
void in_rounds(int threads, const std::function<void(int thread)>& work, const std::function<bool()>& next);

/// Exercise 14.5. Sweeps on `threads` threads, one colour after another, and shares the packs of a colour among the
/// threads: Eq. (14.10). The result is the same to the last bit for any number of threads. Stop rule, V, exceptions and
/// history follow the contract of solve(); without packs there is no sweep. Throws std::invalid_argument, naming
/// threads, unless they are from 1 to 256.
template <int Dof>
SolveReport solve_in_colours(std::vector<Colour<Dof>>& colours, std::vector<Twist<Dof>>& V,
                             const StopRule& stop, int threads);

/// Two impulses in each lane [N s]: along t1 in column 0, along t2 in column 1.
using LanePairs = Eigen::Array<double, lane_count, 2>;

/// Exercise 14.6. Returns the nearest point of the disc |λ_t| <= radius in each lane, without a branch: Eq.
/// (14.14), that is Eq. (9.4). Returns zero for a radius of 0, even if λ_t is 0, as in an empty lane.
LanePairs onto_discs(const LanePairs& lambda, const Lanes& radius);

/// Updates the contacts of a pack with μ, in their order, using onto_discs(): Eq. (4.7) and then (9.6), in each lane.
/// Given. Returns the largest S_kk |Δλ_k| or s |Δλ_t| [m/s].
template <int Dof>
double update_contact_pack(Pack<Dof>& pack, std::vector<Twist<Dof>>& V);

}  // namespace spook
