#pragma once
// A step of order four, composed of five leapfrogs, the middle one backwards in time: Eq. (1.11), (1.13).
//
//   parts     w, w, 1 - 4w, w, w  of h,  w = 1/(4 - ∛4)                                       Suzuki, Eq. (1.13)
//   a part    half a kick, drift, half a kick; where two parts meet, their half kicks are one
//   joints    kick with Gᵀλ, G at the places before the drift, such that every gap is 0 after it
//   the end   half a kick with Gᵀμ, such that G v = 0: velocities are of the time of the positions
//
// A part with its joints is SHAKE, and with the last line RATTLE (Ryckaert, Ciccotti and Berendsen; Andersen): of second
// order, and its own inverse with -h, whatever the sign of h. So five of them make order four (Reich).
//
// SPOOK's own rows cannot take the place of these. With d = 0 they are symmetric, too, but a gap trails: h²A/4 for an
// acceleration A of its points. What is right for parts of one length is wrong for the next, of another: composed, they
// stay of second order. With d > 0 a step loses energy, which none backwards gives back. So joints are rigid here: d = 0,
// and k, as if it were infinite, plays no part.
//
//   λ       the gaps after the drift are a function of λ, and what each correction lacks is solved for with
//           S = G M⁻¹ Gᵀ at the start of the part, factorised once; each leaves about the share h ω of the one before,
//           with ω of what turns. Where it does not shrink by half, as near places where a mechanism could go on in two
//           ways, the next are with G after the drift on the left, G₁ M⁻¹ Gᵀ, which is dense and slow and seldom wanted
//   Σ       1e-12 of the diagonal, so that rows that repeat each other share their load; it slows the corrections by no
//           more than that, and the gaps are 0 to roundings with it or without
#include <array>
#include <cmath>
#include <vector>

#include "11_direct/direct.hpp"
#include "engine/constraints/joints.hpp"
#include "engine/integration/rotation.hpp"

namespace spook {

/// The parts of a step: Eq. (1.13).
inline const std::array<double, 5>& parts_of_order_four() {
  static const double w = 1 / (4 - std::cbrt(4.0));
  static const std::array<double, 5> parts = {w, w, 1 - 4 * w, w, w};
  return parts;
}

/// S of rows: its inverse where they are few, its factors where they are many.
class RowFactors {
 public:
  /// Returns false where a pivot is not sound.
  template <int Dof>
  bool factorise(const std::vector<Row<Dof>>& rows);

  /// S x = right.
  void solve(const Vector& right, Vector& x) const;

 private:
  bool few_ = true;
  Eigen::MatrixXd S_, inverse_;
  Factors many_;
};

/// The joints of a step that is composed.
template <int Dof>
class RattleJoints {
 public:
  /// Once a step, before all that follows.
  void begin_step(const Bodies<Dof>& bodies) { ahead_ = bodies; }

  /// Rows of the joints, where the bodies are. They go on with the λ that they had.
  void begin(const std::vector<Joint>& joints, const Bodies<Dof>& bodies, std::vector<Row<Dof>>& rows,
             SolveReport& report);

  /// Moves the bodies on by `h` of either sign, with impulses such that no joint has a gap then. They are added to the
  /// rows, and what was lacking before each correction [m/s] into the report, which has not converged where they do not
  /// suffice.
  void drift(const std::vector<Joint>& joints, double h, const StopRule& stop,
             const RotationRule<Dof>& rotation, std::vector<Row<Dof>>& rows, Bodies<Dof>& bodies,
             SolveReport& report);

  /// Takes out what velocities have along the rows.
  void stop(std::vector<Row<Dof>>& rows, Bodies<Dof>& bodies);

 private:
  void turn_with_the_rows(const std::vector<Joint>& joints, const std::vector<Row<Dof>>& rows);
  void apply(std::vector<Row<Dof>>& rows, Motion<Dof>& motion) const;

  RowFactors factors_;
  Bodies<Dof> ahead_;  // after the drift; what does not move is where it is
  Vector lacking_;     // of each row [m/s]
  Vector impulses_;    // that make up for it [N s]
  Vector lambda_;      // so far in the step [N s]
};

/// The gap of every row that holds a joint, in the order of add_joint_rows [m or rad], into `gaps`, which has as many
/// entries; returns by how much roundings blur them.
template <int Dof>
double joint_gaps(const std::vector<Joint>& joints, const Bodies<Dof>& bodies, Vector& gaps);

}  // namespace spook
