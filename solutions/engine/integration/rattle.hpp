#pragma once
// A step of order four, composed of five leapfrogs, the middle one backwards in time: Eq. (1.11), (1.13).
//
//   parts     w, w, 1 - 4w, w, w  of h,  w = 1/(4 - ∛4)                                       Suzuki, Eq. (1.13)
//   a part    half a kick, drift, half a kick; the half kicks of consecutive parts are merged
//   joints    kick with Gᵀλ, G at the positions before the drift, such that every gap is 0 after the drift
//   the end   half a kick with Gᵀμ, such that G v = 0: velocities and positions belong to the same time
//
// A part with joints is SHAKE; with the last line it is RATTLE (Ryckaert, Ciccotti and Berendsen; Andersen). RATTLE is
// of second order, and a step of -h is its inverse. So five steps compose a step of order four (Reich).
//
// SPOOK's own rows cannot replace RATTLE. With d = 0 they are symmetric, too, but leave a gap of h²A/4 at an
// acceleration A of the points. This gap depends on the length of a part, which changes from part to part: composed
// steps stay of second order. With d > 0 a step dissipates energy, which a step backwards does not restore. So joints
// are rigid here: d = 0, and k has no effect.
//
//   λ       solves gaps(λ) = 0 after the drift by corrections with S = G M⁻¹ Gᵀ of the start of the part, factorised
//           once. A correction reduces the gaps about by the factor h ω, with the angular velocity ω. If a correction
//           does not halve the gaps, as near a bifurcation of a mechanism, the next corrections use G₁ M⁻¹ Gᵀ, with G₁
//           after the drift; that matrix is dense and slow, but seldom needed
//   Σ       1e-12 of the diagonal, so that redundant rows share their load. It slows convergence by as little, and the
//           gaps are 0 up to round-off with any Σ
#include <array>
#include <cmath>
#include <vector>

#include "11_direct/direct.hpp"
#include "engine/constraints/joints.hpp"
#include "engine/integration/rotation.hpp"

namespace spook {

/// The parts of a step as fractions of h: Eq. (1.13).
inline const std::array<double, 5>& parts_of_order_four() {
  static const double w = 1 / (4 - std::cbrt(4.0));
  static const std::array<double, 5> parts = {w, w, 1 - 4 * w, w, w};
  return parts;
}

/// S of the rows: stored as an inverse for few rows, and as factors for many.
class RowFactors {
 public:
  /// Factorises S; returns false if a pivot is not positive.
  template <int Dof>
  bool factorise(const std::vector<Row<Dof>>& rows);

  /// Solves S x = right.
  void solve(const Vector& right, Vector& x) const;

 private:
  bool few_ = true;
  Eigen::MatrixXd S_, inverse_;
  Factors many_;
};

/// The joints in a step of order four.
template <int Dof>
class RattleJoints {
 public:
  /// Starts a step; call it once, before the other functions.
  void begin_step(const Bodies<Dof>& bodies) { ahead_ = bodies; }

  /// Builds the rows of the joints at the current positions. Rows keep their λ.
  void begin(const std::vector<Joint>& joints, const Bodies<Dof>& bodies, std::vector<Row<Dof>>& rows,
             SolveReport& report);

  /// Moves the bodies for a time `h` of either sign [s], with impulses that close the gaps of all joints. Adds the
  /// impulses to the λ of the rows, and the error before each correction [m/s] to the report's history. If the
  /// corrections do not suffice, the report has not converged.
  void drift(const std::vector<Joint>& joints, double h, const StopRule& stop,
             const RotationRule<Dof>& rotation, std::vector<Row<Dof>>& rows, Bodies<Dof>& bodies,
             SolveReport& report);

  /// Removes the velocities along the rows, such that G v = 0.
  void stop(std::vector<Row<Dof>>& rows, Bodies<Dof>& bodies);

 private:
  void turn_with_the_rows(const std::vector<Joint>& joints, const std::vector<Row<Dof>>& rows);
  void apply(std::vector<Row<Dof>>& rows, Motion<Dof>& motion) const;

  RowFactors factors_;
  Bodies<Dof> ahead_;  // the bodies after the drift
  Vector errors_;      // error of each row [m/s]
  Vector impulses_;    // correction of each row [N s]
  Vector lambda_;      // of each row, so far in the step [N s]
};

/// Writes the gap of every holding row, in the order of add_joint_rows [m or rad], into `gaps`, which has as many
/// entries. Returns a bound of the round-off in the gaps.
template <int Dof>
double joint_gaps(const std::vector<Joint>& joints, const Bodies<Dof>& bodies, Vector& gaps);

}  // namespace spook
