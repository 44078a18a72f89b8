// Overlaps and exceeded limits leave no speed: engine/solvers/recovery.hpp.
#include <algorithm>
#include <cmath>

#include "engine/constraints/joint_recovery.hpp"
#include "engine/solvers/recovery.hpp"

namespace spook {

/// Solves once more, for velocities without the speed of recovery. Contacts that open more slowly than |gravity| h/100
/// are ignored: they close again in the next step.
template <int Dof>
void World<Dof>::solve_again(double h) {
  const double size = std::isfinite(shapes_.smallest) ? shapes_.smallest : 0;
  const double ignored = 1e-2 * settings_.gravity.norm() * h + 1e-9 * size / h;
  std::function<bool(const Contact&)> may_throw = nullptr;
  if (materials_.any())
    may_throw = [&](const Contact& c) { return materials_.of(c.i, c.j).k < materials_.stiffness(); };
  StopRule stop = stop_rule(h);
  // Where there are joints, the second solve holds them as exactly as the first.
  if (joints_.empty()) stop.tolerance = std::max(stop.tolerance, 0.1 * ignored);
  const JointRecovery joints{.limits = rigid_limits(joints_, joint_rows_, bodies_, settings_.gravity, h),
                             .holding = holding_rows_with_work(joints_, joint_rows_, rows(), bodies_, V_)};
  // The first row of a joint holds it, if any does.
  const auto recovers = [&](std::size_t row) {
    return std::binary_search(joints.holding.begin(), joints.holding.end(), row);
  };
  for (std::size_t n = 0; n < joints_.size(); ++n) joints_[n].recovered = recovers(joint_rows_[n]);
  if (!prepare_second_solve(solver_input(V_, h, stop), ignored, may_throw, joints, first_solve_)) return;
  std::vector<Twist<Dof>> V = V_;
  const SolverResult solved = settings_.solver.solve(solver_input(V, h, stop));
  row_updates_ += solved.updates(rows().size());
  limit_energy(solver_input(V, h, stop), next_joint_row_, first_solve_.changed, may_throw);
  add_work_of_drives(V);  // these velocities go on
  restore(first_solve_.rows, constraints_.rows);
  recovered_.resize(V.size());
  for (std::size_t i = 0; i < V.size(); ++i) recovered_[i] = V[i] - V_[i];
}

/// Turns a rigid body by ω, and returns its ω afterwards. If its velocity has recovery, it returns the ω without it,
/// turned with the body, so that the energy stays. Not constrained to six degrees of freedom, since clang 14
/// instantiates the members of World<3> without regard to their constraints.
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
