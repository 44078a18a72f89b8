#pragma once
// Chapter 14 · Rows for a machine
//
// The same rows, with less waiting: a contact's three rows as one block; colours, so that what is updated side by side
// shares no body that moves; four rows in the lanes of one instruction; a colour on several threads.
//
//   block of a contact   S_cc = G M⁻¹ Gᵀ + Σ,  3 x 3                                    Eq. (14.1)    not in the notes
//   what it asks for     q = r + S_cc λ                                                 Eq. (14.2)    not in the notes
//   it parts             q_n <= 0:  λ = 0                                               Eq. (14.3)    notes (31)
//   it sticks            S_cc λ = q  within |λ_t| <= μ λ_n                              Eq. (14.4)    notes (3)
//   it slides            (S_cc + diag(0, α, α)) λ = q,  |λ_t| = μ λ_n,  α > 0           Eq. (14.5)    not in the notes
//   colours              the smallest that neither body has yet                         Eq. (14.7)    not in the notes
//   their number         <= 2 Δ - 1,  Δ the most pairs on a body                        Eq. (14.8)    not in the notes
//   lanes                Eq. (4.6), (4.7) in each, Δλ = 0 in an empty one               Eq. (14.9)    not in the notes
//   discs in lanes       λ_t m,  m = 1 where |λ_t| <= Λ, else Λ/|λ_t|                   Eq. (14.14)   not in the notes
//
//   r   what the three rows lack, Eq. (4.6) [m/s]         α   slip over friction [1/kg]
//
// Nothing here is about another physics: a solver of this chapter has the solution of chapter 04's or 09's.
#include <array>

#include "10_convergence/convergence.hpp"

namespace spook {

/// Exercise 14.1. The impulses (λ_n, λ_1, λ_2) [N s] of a contact by itself, on Coulomb's cone: Eq. (14.3)-(14.6).
/// `S` is symmetric and positive definite [1/kg], `q` what the rows ask for [m/s], `mu` at least 0 and finite. At most
/// a few roundings outside the cone, and not outside λ_n >= 0.
Vec3 solve_on_cone(const Mat3& S, const Vec3& q, double mu);

/// Exercise 14.2. Brings the three rows of a contact up to date at once: Eq. (14.1), (14.2), then Eq. (14.3)-(14.6).
/// Their bounds are neither looked at nor set. Returns |S_cc Δλ| [m/s].
template <int Dof>
double update_contact(const FrictionContact& contact, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V);

/// Exercise 14.3. A colour, 0, 1, 2 ..., for each pair of bodies, so that two pairs of one colour share none that moves:
/// Eq. (14.7). A body that does not move is -1 here. The pairs take their colours in the order in which they come; a
/// body may be in any number of them. `bodies`: how many there are.
std::vector<int> colour_pairs(const std::vector<Pair>& pairs, std::size_t bodies);

/// Number of lanes.
inline constexpr int lane_count = 4;

/// One number in each lane.
using Lanes = Eigen::Array<double, lane_count, 1>;

/// A velocity or a Jacobian block in each lane: column d has its component d, in all lanes.
template <int Dof>
using LaneTwists = Eigen::Array<double, lane_count, Dof>;

/// A row in each lane, of as many different pairs of bodies. At first all lanes are empty: zeros, but a diagonal of 1.
template <int Dof>
struct LaneRows {
  LaneTwists<Dof> Gi = LaneTwists<Dof>::Zero(), Gj = Gi, MinvGi = Gi, MinvGj = Gi;
  Lanes B = Lanes::Zero(), Sigma = B, diagonal = Lanes::Ones(), lo = B, hi = B, lambda = B;
};

/// Four pairs of bodies that share none that moves, and the rows between them: the first of each pair, the second ...
template <int Dof>
struct Pack {
  std::array<int, lane_count> i = {-1, -1, -1, -1}, j = i;  ///< -1: it does not move, or the lane is empty
  std::array<int, lane_count> first = i;  ///< each lane's first row in the list that was packed; -1: none
  std::vector<LaneRows<Dof>> rows;
  std::vector<Lanes> mu = {};  ///< of each three rows, where these are a contact's with friction; else empty
};

/// Exercise 14.4. Brings all rows of a pack up to date, in their order: Eq. (14.9), that is Eq. (4.6), (4.7) in each
/// lane. Where the index of a body is -1 its velocity is 0, and nothing is written. Returns the largest S_kk |Δλ_k|
/// [m/s].
template <int Dof>
double update_pack(Pack<Dof>& pack, std::vector<Twist<Dof>>& V);

/// Packs that share no body that moves.
template <int Dof>
using Colour = std::vector<Pack<Dof>>;

/// All rows as packs, by colour_pairs(), which is given. Rows of the same two bodies that follow each other stay together,
/// and in their order. `bodies`: how many there are. The rows of `contacts` are in packs of their own, with μ.
template <int Dof>
std::vector<Colour<Dof>> packed(const std::vector<Row<Dof>>& rows, std::size_t bodies,
                                const std::vector<FrictionContact>& contacts = {});

/// Copies the λ of packs back to the rows of which they were made. Given.
template <int Dof>
void unpack(const std::vector<Colour<Dof>>& colours, std::vector<Row<Dof>>& rows);

/// Work on several threads, in rounds, which is given: calls work(0), work(1) ... work(threads - 1) at the same time.
/// When all have returned it asks `next`, once, and begins again as long as that says true. What one of them throws is
/// thrown at the end of its round. One thread is this one: no other is started.
void in_rounds(int threads, const std::function<void(int thread)>& work, const std::function<bool()>& next);

/// Exercise 14.5. Sweeps on `threads` threads: colour after colour, and the packs of a colour shared among them, Eq.
/// (14.10). The result is the same to the last bit, whatever their number. Contract of solve(), of which V, the stop
/// rule, what is thrown, and the history are part; without packs there is no sweep. Throws std::invalid_argument,
/// naming threads, unless they are from 1 to 256.
template <int Dof>
SolveReport solve_in_colours(std::vector<Colour<Dof>>& colours, std::vector<Twist<Dof>>& V,
                             const StopRule& stop, int threads);

/// Two impulses in each lane [N s]: along t1 in column 0, along t2 in column 1.
using LanePairs = Eigen::Array<double, lane_count, 2>;

/// Exercise 14.6. In each lane the point of the disc |λ_t| <= radius that is nearest, without a branch: Eq. (14.14),
/// that is Eq. (9.4). Zero for a radius of 0, also where λ_t is 0, as in an empty lane.
LanePairs onto_discs(const LanePairs& lambda, const Lanes& radius);

/// Brings the contacts of a pack with μ up to date, in their order, by onto_discs(): Eq. (4.7) and then (9.6), in each
/// lane. Given. Returns the largest S_kk |Δλ_k| or s |Δλ_t| [m/s].
template <int Dof>
double update_contact_pack(Pack<Dof>& pack, std::vector<Twist<Dof>>& V);

}  // namespace spook
