#pragma once
// Rows of soft steps: a spring and a damper for each row, by a frequency and a damping ratio, Eq. (10.16)-(10.18).
//
//   velocities V of a sweep are the bodies' own, forces included: V = W + W_f + M⁻¹ Gᵀ λ, so B has no G W
//   soft        a closed gap     B = -a g, Σ = S/(h ω (2ζ + h ω)); for a limit B is at most the closing speed
//   relaxed     the same gap     B = 0,  Σ = 0                                              Eq. (10.15)
//   both        an open gap      B = -g/h,  Σ = 0: closes it in a substep at most           Eq. (13.11)
//               others           as they were built: motors, joints with a k of their own
//
// Joints have these rows; soft_contacts.hpp has the contacts.
#include <numbers>

#include "engine/constraints/joints.hpp"

namespace spook {

/// The spring of a row in soft steps.
struct SoftSpring {
  double frequency;  ///< of its undamped oscillation [1/substep]
  double damping;    ///< damping ratio ζ; 1: critical

  /// h ω, which is 2π times the frequency.
  double turn() const { return 2 * std::numbers::pi * frequency; }
  /// h a, the part of a gap that is closed in a substep, and Σ/S: Eq. (10.17).
  double closed_part() const { return turn() / (2 * damping + turn()); }
  double softness() const { return 1 / (turn() * (2 * damping + turn())); }
};

/// Soft steps, the method of today's game engines: several substeps in one search for contacts. A substep sweeps soft
/// rows, moves the bodies, and sweeps rigid rows, from the impulses of the last one: Eq. (10.15), (10.16). The more
/// substeps, the higher structures stand: Eq. (10.22).
struct SoftSteps {
  int substeps = 4;                                     ///< in a step, 1 to 1024
  SoftSpring contacts{.frequency = 0.2, .damping = 5};  ///< 48 Hz in 4 substeps of a step of 1/60 s
  SoftSpring joints{.frequency = 0.25, .damping = 2};   ///< 60 Hz there. Joints with a k are springs instead
  double closing_speed = 3;  ///< largest speed at which an overlap is moved apart [m/s]
};

/// Throws std::invalid_argument, naming the parameter, unless substeps are 1 to 1024, and all other numbers are
/// positive and finite.
void require_sound(const SoftSteps& soft);

/// The target of a row in soft steps.
enum class SoftKind {
  unchanged,  ///< the row stays as it was built: a motor, or a joint with a k of its own
  holds,      ///< a joint: holds it at zero
  limits,     ///< a limit: stops it at zero
};

/// The gap that a joint's row of soft steps follows.
struct SoftGap {
  SoftKind kind = SoftKind::unchanged;
  double gap = 0;  ///< [m or rad]
  double S = 0;    ///< S_kk without Σ [1/kg]
};

/// Returns S_kk without Σ [1/kg].
template <int Dof>
double rigid_diagonal(const Row<Dof>& row) {
  return row.Gi.dot(row.MinvGi) + row.Gj.dot(row.MinvGj);
}

/// Sets B, Σ and S_kk of a row for the soft sweep of a substep of `h` [s].
template <int Dof>
void make_soft(const SoftGap& at, const SoftSpring& spring, double closing_speed, double h, Row<Dof>& row);

/// Sets them for the relaxing sweep.
template <int Dof>
void make_rigid(const SoftGap& at, double h, Row<Dof>& row);

/// Turns the rows of a joint, which were built for bodies without velocities, into rows of a substep of `h` [s]. Sets
/// the gap of each. Rows of a joint with a k become those of implicit Euler.
template <int Dof>
void soften_joint(const Joint& joint, double h, Row<Dof>* rows, SoftGap* gaps);

}  // namespace spook
