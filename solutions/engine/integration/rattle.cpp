#include "engine/integration/rattle.hpp"

#include <algorithm>
#include <limits>

#include "engine/constraints/joint_rows.hpp"
#include "engine/linear/schur_entry.hpp"
#include "engine/support/larger.hpp"

namespace spook {

static constexpr std::size_t few_rows = 12;      // rows
static constexpr double joint_softness = 1e-12;  // Σ, of the diagonal
// Tolerances in rounding errors: the smallest attainable gaps, and the smallest near a bifurcation.
static constexpr double blurred = 100, stuck = 1e4;

/// Inverts a symmetric matrix of N rows by its closed form; returns false if it is not positive definite.
template <int N>
static bool invert(const Eigen::MatrixXd& S, Eigen::MatrixXd& inverse) {
  const Eigen::Matrix<double, N, N> all = S.topLeftCorner<N, N>().template selfadjointView<Eigen::Lower>();
  inverse = all.inverse();
  return all.determinant() > 0;
}

/// Inverts a symmetric matrix of any size by Cholesky factors, and overwrites S; returns false if it is not positive
/// definite.
static bool invert(Eigen::MatrixXd& S, Eigen::MatrixXd& inverse) {
  if (S.rows() == 1) return invert<1>(S, inverse);
  if (S.rows() == 2) return invert<2>(S, inverse);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factors(S);  // in place
  if (factors.info() != Eigen::Success) return false;
  inverse.setIdentity(S.rows(), S.rows());
  for (auto column : inverse.colwise()) factors.solveInPlace(column);
  return true;
}

template <int Dof>
bool RowFactors::factorise(const std::vector<Row<Dof>>& rows) {
  few_ = rows.size() <= few_rows;
  if (!few_) return spook::factorise(schur_complement(rows), many_);
  const auto n = static_cast<Eigen::Index>(rows.size());
  const auto row = [&](Eigen::Index k) -> const Row<Dof>& { return rows[static_cast<std::size_t>(k)]; };
  S_.resize(n, n);
  for (Eigen::Index l = 0; l < n; ++l) {
    for (Eigen::Index k = l; k < n; ++k) S_(k, l) = schur_entry(row(k), row(l));
    S_(l, l) += row(l).Sigma;
  }
  return invert(S_, inverse_);
}

void RowFactors::solve(const Vector& right, Vector& x) const {
  if (few_)
    x.noalias() = inverse_.lazyProduct(right);
  else
    x = many_.ldlt.solve(right);
}

/// Writes the gaps of a hinge, a slider or a weld, from `row` on; returns their number.
static Eigen::Index add_guided(const Joint& joint, const Bodies<6>& bodies, const Vec3& apart, Eigen::Index row,
                               Vector& gaps) {
  const JointFrames at = frames(joint, bodies);
  const std::array<Coordinate, 3> turned = turned_apart(at.i, at.j);
  Eigen::Index n = row;
  if (joint.kind == JointKind::slider)
    for (int axis = 0; axis < 2; ++axis) gaps[n++] = shift_along(at.i, at.j, axis).value;
  else
    for (const double gap : apart) gaps[n++] = gap;
  for (std::size_t axis = 0; n < row + joint.holding_rows(); ++axis) gaps[n++] = turned[axis].value;
  return n - row;
}

template <int Dof>
double joint_gaps(const std::vector<Joint>& joints, const Bodies<Dof>& bodies, Vector& gaps) {
  double reach = 0;
  Eigen::Index row = 0;
  for (const Joint& joint : joints) {
    const Attachment i = attachment(joint.i, joint.p_i, bodies), j = attachment(joint.j, joint.p_j, bodies);
    const Vec3 at_i = i.x + i.r, at_j = j.x + j.r, apart = at_j - at_i;
    reach = std::max({reach, at_j.cwiseAbs().maxCoeff(), at_i.cwiseAbs().maxCoeff()});
    if (joint.length) {
      gaps[row++] = apart.norm() - *joint.length;
      continue;
    }
    if constexpr (Dof == 6)
      if (joint.is_guided()) {
        row += add_guided(joint, bodies, apart, row, gaps);
        reach = std::max(reach, 1.0);  // rad
        continue;
      }
    gaps.segment<3>(row) = apart;
    row += 3;
  }
  return 8 * std::numeric_limits<double>::epsilon() * reach;
}

template <int Dof>
void RattleJoints<Dof>::begin(const std::vector<Joint>& joints, const Bodies<Dof>& bodies,
                              std::vector<Row<Dof>>& rows, SolveReport& report) {
  if (joints.empty()) return;
  lambda_.setZero(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) lambda_[static_cast<Eigen::Index>(k)] = rows[k].lambda;
  rows.clear();
  add_joint_rows(joints, 1, bodies, rows);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k].B = 0;
    rows[k].Sigma = joint_softness * rows[k].diagonal;
    if (lambda_.size() > 0) rows[k].lambda = lambda_[static_cast<Eigen::Index>(k)];
  }
  errors_.resize(static_cast<Eigen::Index>(rows.size()));
  if (factors_.factorise(rows)) return;
  report.converged = false;
  report.trouble = "the rows of the joints could not be factorised";
}

/// Computes the correction with the rows after the drift, if corrections converge too slowly, as near redundant rows.
template <int Dof>
void RattleJoints<Dof>::turn_with_the_rows(const std::vector<Joint>& joints,
                                           const std::vector<Row<Dof>>& rows) {
  std::vector<Row<Dof>> ahead;
  add_joint_rows(joints, 1, ahead_, ahead);
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd A(n, n);
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index l = 0; l < n; ++l)
      A(k, l) = schur_entry(rows[static_cast<std::size_t>(l)], ahead[static_cast<std::size_t>(k)]);
  impulses_ = Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(A).solve(errors_);
}

/// Applies the correction to the rows.
template <int Dof>
void RattleJoints<Dof>::apply(std::vector<Row<Dof>>& rows, Motion<Dof>& motion) const {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double impulse = -impulses_[static_cast<Eigen::Index>(k)];
    apply_impulse(rows[k], impulse, motion.W);
    rows[k].lambda += impulse;
  }
}

/// Moves bodies with these velocities for `h`.
template <int Dof>
static void move(const Bodies<Dof>& bodies, double h, const RotationRule<Dof>& rotation, Bodies<Dof>& ahead) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.is_fixed(i)) continue;
    ahead.x[i] = drift(bodies.x[i], bodies.motion.W[i].template head<3>(), h);
    if constexpr (Dof == 6) {
      ahead.orientations.q[i] = bodies.orientations.q[i];
      Vec3 omega = bodies.motion.W[i].template tail<3>();
      rotate(rotation, ahead.orientations, i, omega, h);
      ahead.motion.W[i].template tail<3>() = omega;
    }
  }
}

template <int Dof>
void RattleJoints<Dof>::drift(const std::vector<Joint>& joints, double h, const StopRule& stop,
                              const RotationRule<Dof>& rotation, std::vector<Row<Dof>>& rows,
                              Bodies<Dof>& bodies, SolveReport& report) {
  double last = infinity;
  bool turned = false;
  for (int n = 0;; ++n) {
    move(bodies, h, rotation, ahead_);
    if (rows.empty()) break;
    const double roundings = joint_gaps(joints, ahead_, errors_) / std::abs(h);
    double most = 0;
    for (double& error : errors_) {
      error /= h;
      most = larger(most, std::abs(error));
    }
    report.history.push_back(most);
    if (most <= std::max(roundings, stop.tolerance)) break;
    const bool shrinks = most < last / 2;
    if (!shrinks && most <= (turned ? stuck : blurred) * roundings) break;
    if (n == stop.max_sweeps || (turned && !(most < last))) {
      report.converged = false;
      break;
    }
    turned = turned || !shrinks;
    last = most;
    if (turned)
      turn_with_the_rows(joints, rows);
    else
      factors_.solve(errors_, impulses_);
    apply(rows, bodies.motion);
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies.x[i] = ahead_.x[i];
    if constexpr (Dof == 6) {
      bodies.orientations.q[i] = ahead_.orientations.q[i];
      bodies.motion.W[i].template tail<3>() = ahead_.motion.W[i].template tail<3>();
    }
  }
}

template <int Dof>
void RattleJoints<Dof>::stop(std::vector<Row<Dof>>& rows, Bodies<Dof>& bodies) {
  for (std::size_t k = 0; k < rows.size(); ++k)
    errors_[static_cast<Eigen::Index>(k)] =
        rows[k].Gi.dot(bodies.motion.W[rows[k].i]) + rows[k].Gj.dot(bodies.motion.W[rows[k].j]);
  factors_.solve(errors_, impulses_);
  apply(rows, bodies.motion);
}

template bool RowFactors::factorise<3>(const std::vector<Row<3>>&);
template bool RowFactors::factorise<6>(const std::vector<Row<6>>&);
template double joint_gaps<3>(const std::vector<Joint>&, const Bodies<3>&, Vector&);
template double joint_gaps<6>(const std::vector<Joint>&, const Bodies<6>&, Vector&);
template class RattleJoints<3>;
template class RattleJoints<6>;

}  // namespace spook
