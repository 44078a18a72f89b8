// Overlaps and exceeded limits leave no speed: engine/solvers/recovery.hpp.
#include <cmath>

#include "engine/constraints/joint_recovery.hpp"
#include "engine/solvers/recovery.hpp"

namespace spook {

/// A contact that opens by less than a hundredth of |gravity| h closes again in the next step.
template <int Dof>
void World<Dof>::take_out_recovery(double h) {
  const double size = std::isfinite(shapes_.smallest) ? shapes_.smallest : 0;
  const double ignored = 1e-2 * settings_.gravity.norm() * h + 1e-9 * size / h;
  std::function<bool(const Contact&)> may_throw = nullptr;
  if (materials_.any())
    may_throw = [&](const Contact& c) { return materials_.of(c.i, c.j).k < materials_.stiffness(); };
  std::optional<ConstraintSet<Dof>> without = constraints_without_recovery(
      solver_input(constraints_, V_, start_, h, {}), ignored, may_throw,
      {.limits = rigid_limits(joints_, joint_rows_, bodies_, settings_.gravity, h),
       .holding = holding_rows_with_work(joints_, joint_rows_, rows(), bodies_, V_)});
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
