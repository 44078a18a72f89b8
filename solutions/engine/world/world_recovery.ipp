// Overlaps and exceeded limits leave no speed: engine/solvers/recovery.hpp.
#include <cmath>

#include "engine/bodies/conserved_quantities.hpp"
#include "engine/solvers/recovery.hpp"

namespace spook {

/// Returns the square of the speed of a joint's point on j relative to that on i [m²/s²].
template <int Dof>
static double squared_speed(const Joint& joint, const Bodies<Dof>& bodies) {
  const auto velocity = [&](int body, const Vec3& p) -> Vec3 {
    const Twist<Dof>& W = bodies.motion.W[static_cast<std::size_t>(body)];
    Vec3 v = W.template head<3>();
    if constexpr (Dof == 6) v += W.template tail<3>().cross(attachment(body, p, bodies).r);
    return v;
  };
  return (velocity(joint.j, joint.p_j) - velocity(joint.i, joint.p_i)).squaredNorm();
}

/// Returns the rows of limits and ropes without a k of their own. A step in which one opens by less than 1e-9 of its
/// range, or than 1e-9 rad, does not count. A taut rope that swings at a speed v leaves its circle by v² h²/(2 l) in
/// each step, and opens at v² h/(2 l) to come back to it: that is no recovery. Where it turns, v is 0, and what it opens
/// from the steps before is less than a hundredth of |gravity| h.
template <int Dof>
std::vector<RigidLimit> World<Dof>::rigid_limits(double h) const {
  std::vector<RigidLimit> limits;
  for (std::size_t n = 0; n < joints_.size(); ++n) {
    const Joint& joint = joints_[n];
    const bool is_hinge = joint.kind == JointKind::hinge, is_rope = joint.kind == JointKind::rope;
    if (!(is_rope || joint.limits) || !(is_hinge ? joint.has_default_k_turn : joint.has_default_k)) continue;
    const double range = is_hinge ? 1 : is_rope ? *joint.length : joint.limits->upper - joint.limits->lower;
    const double swings =
        is_rope ? squared_speed(joint, bodies_) * h / range + 1e-2 * settings_.gravity.norm() * h : 0;
    limits.push_back({.row = joint_rows_[n] + static_cast<std::size_t>(is_rope ? 0 : joint.holding_rows()),
                      .ignored = 1e-9 * (std::isfinite(range) ? range : 0) / h + swings});
  }
  return limits;
}

/// Returns the rows that hold joints without a k of their own if their work, Eq. (13.19), is more than a hundredth of
/// three kinetic energies: before the step, after it, and that which forces alone would give a resting world; else none.
/// Returns none, too, if a gap is more than a twentieth of an arm. No step has left such a gap: the joint did not fit its
/// bodies, and is pulled together.
template <int Dof>
std::vector<std::size_t> World<Dof>::rows_that_work() const {
  const Motion<Dof>& motion = bodies_.motion;
  const auto mean = [&](int body) -> Twist<Dof> {
    return motion.W[body] + 0.5 * (motion.Wf[body] + V_[static_cast<std::size_t>(body)]);
  };
  double work = 0;
  std::vector<std::size_t> found;
  for (std::size_t n = 0; n < joints_.size(); ++n) {
    const Joint& joint = joints_[n];
    if (!joint.has_default_k || joint.kind == JointKind::rope) continue;
    for (int of_joint = 0; of_joint < joint.holding_rows(); ++of_joint) {
      if (joint.turns(of_joint) && !joint.has_default_k_turn) continue;
      const std::size_t k = joint_rows_[n] + static_cast<std::size_t>(of_joint);
      const Row<Dof>& row = rows()[k];
      work += row.lambda * (row.Gi.dot(mean(row.i)) + row.Gj.dot(mean(row.j)));
      found.push_back(k);
    }
  }
  const auto exceeds = [&](const std::vector<Twist<Dof>>& W) {
    return work > 1e-2 * kinetic_energy(bodies_, W);
  };
  if (!(work > 0) || !exceeds(motion.W) || !exceeds(motion.Wf)) return {};
  std::vector<Twist<Dof>> after = motion.W;
  for (std::size_t i = 0; i < after.size(); ++i) after[i] += motion.Wf[i] + V_[i];
  if (!exceeds(after)) return {};
  for (const Joint& joint : joints_) {
    const JointGap gap = gap_of(joint, bodies_);
    const double arm = std::max({joint.p_i.norm(), joint.p_j.norm(), joint.length.value_or(0)});
    if (joint.has_default_k && joint.kind != JointKind::rope &&
        (gap.apart.norm() > 0.05 * arm || gap.turned.norm() > 0.05))
      return {};
  }
  return found;
}

/// A contact that opens by less than a hundredth of |gravity| h closes again in the next step.
template <int Dof>
void World<Dof>::take_out_recovery(double h) {
  const double size = std::isfinite(shapes_.smallest) ? shapes_.smallest : 0;
  const double ignored = 1e-2 * settings_.gravity.norm() * h + 1e-9 * size / h;
  std::function<bool(const Contact&)> may_throw = nullptr;
  if (materials_.any())
    may_throw = [&](const Contact& c) { return materials_.of(c.i, c.j).k < materials_.stiffness(); };
  std::optional<ConstraintSet<Dof>> without =
      constraints_without_recovery(solver_input(constraints_, V_, start_, h, {}), ignored, may_throw,
                                   {.limits = rigid_limits(h), .holding = rows_that_work()});
  if (!without) return;
  StopRule stop = stop_rule(h);
  // Where there are joints, the second solve holds them as exactly as the first.
  if (joints_.empty()) stop.tolerance = std::max(stop.tolerance, 0.1 * ignored);
  WarmStartCache first;
  first.remember(*without, contacts_, h, settings_.threads);
  std::vector<Twist<Dof>> V = V_;
  const SolverResult solved = settings_.solver.solve(solver_input(*without, V, first, h, stop));
  row_updates_ += solved.updates(without->rows.size());
  recovered_.resize(V.size());
  for (std::size_t i = 0; i < V.size(); ++i) recovered_[i] = V[i] - V_[i];
}

/// Turns a rigid body by ω, and returns its ω afterwards. Where an overlap recovers, that is the ω without recovery, the
/// same in the body's own axes: its energy stays. Not constrained to six degrees of freedom, since clang 14 instantiates
/// the members of World<3> without regard to their constraints.
template <int Dof>
Vec3 World<Dof>::turned(std::size_t i, Vec3 omega, double h) {
  if constexpr (Dof == 6) {
    Quat& q = bodies_.orientations.q[i];
    if (recovered_.empty() || recovered_[i].template tail<3>().isZero(0)) {
      rotate(settings_.rotation, bodies_.orientations, i, omega, h);
      return omega;
    }
    const Quat before = q;
    Vec3 kept = omega + recovered_[i].template tail<3>();
    rotate(settings_.rotation, bodies_.orientations, i, kept, h);
    const Vec3 in_body = q.conjugate() * kept;
    q = before;
    rotate(settings_.rotation, bodies_.orientations, i, omega, h);
    return q * in_body;
  }
  return omega;
}

}  // namespace spook
