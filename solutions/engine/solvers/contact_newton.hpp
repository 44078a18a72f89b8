#pragma once
// What an update of a contact, or of a row, would do, made linear: Δλ = k - K G v, for what v adds to the velocities.
//
//   free, or held   of a row:  G v + Σ Δλ = r,  or Δλ = bound - λ
//   open            λ_n + r_n/S_nn <= 0:            Δλ = -λ
//   sticks          |q| <= μ λ̂_n:                   G v + Σ Δλ = r
//   slides          λ_t = μ λ_n d, that is          Δλ_t = μ (λ_n + Δλ_n) d - λ_t   along d
//                   and, as d turns with q,         Δλ_t = c (λ_t + Δλ_t + (r_t - G v - Γ Δλ_t)/s) - λ_t   across it
//
//   λ̂_n   λ_n + r_n/S_nn                     d   q/|q|           Γ   Σ of friction
//   q     λ_t + r_t/s, Eq. (9.5), (9.6)      c   μ λ̂_n/|q|, less than 1
//
// K is not symmetric where something slides: what presses more rubs more.
#include <algorithm>

#include "09_better_friction/better_friction.hpp"

namespace spook {

/// The rows of a contact that rubs, or one row by itself.
struct ContactBlock {
  std::size_t row;
  int count;
  double mu = 0, s = 0;   ///< of friction: μ, and Eq. (9.5)
  Mat3 K = Mat3::Zero();  ///< [kg]
  Vec3 k = Vec3::Zero();  ///< [N s]
};

/// Sets K and k of a row that lacks `r`; returns what it aims at, before its bounds. `softer`: what is added to Σ, in S_kk.
template <int Dof>
double linearise_row(const Row<Dof>& row, double r, double softer, ContactBlock& part) {
  const double aim = row.lambda + r / row.diagonal;
  part.K.setZero();
  part.k.setZero();
  if (row.lo < aim && aim < row.hi) {
    part.K(0, 0) = 1 / (row.Sigma + softer * row.diagonal);
    part.k[0] = part.K(0, 0) * r;
  } else {
    part.k[0] = std::clamp(aim, row.lo, row.hi) - row.lambda;
  }
  return aim;
}

/// Sets K and k of a part, whose rows begin at `rows` and lack `r` [m/s], Eq. (4.6).
template <int Dof>
void linearise(const Row<Dof>* rows, const Vec3& r, double softer, ContactBlock& part) {
  const double limit = part.mu * linearise_row(*rows, r[0], softer, part);
  if (part.count == 1) return;
  const Vec2 along(rows[1].lambda, rows[2].lambda), lacks = r.tail<2>(), q = along + lacks / part.s;
  const double soft = rows[1].Sigma + softer * part.s, size = q.norm();
  if (limit <= 0) {  // open, or smooth
    part.k.tail<2>() = -along;
  } else if (size <= limit) {  // sticks
    part.K(1, 1) = part.K(2, 2) = 1 / soft;
    part.k.tail<2>() = lacks / soft;
  } else {  // slides
    const Vec2 d = q / size, across(-d[1], d[0]);
    const double c = limit / size, turns = 1 - c + c * soft / part.s;
    part.K.block<2, 2>(1, 1) = c / part.s / turns * across * across.transpose();
    part.K.block<2, 1>(1, 0) = part.mu * part.K(0, 0) * d;
    part.k.tail<2>() =
        (part.mu * (rows[0].lambda + part.k[0]) - along.dot(d)) * d - along.dot(across) / turns * across;
  }
}

}  // namespace spook
