// Motors, springs and limits of hinges and sliders: changes between steps, their work in a step, and their forces.
#include <algorithm>
#include <cmath>

#include "common/require.hpp"

namespace spook {

template <int Dof>
void World<Dof>::set_motor(int joint, const std::optional<Motor>& motor) requires(Dof == 6) {
  Joint& driven = joints_[joint_index(joint)];
  require_kind(driven.has_free_axis(), driven, "hinge or slider, where it has a motor");
  if (motor) require_sound(*motor);
  if (motor) require_for_order_four({.i = 0, .j = 0, .d = 0, .motor = motor});
  const bool as_many_rows = motor.has_value() == driven.motor.has_value();
  driven.motor = motor;
  if (!as_many_rows) forget_the_last_step();
}

template <int Dof>
void World<Dof>::set_spring(int joint, const std::optional<Spring>& spring) requires(Dof == 6) {
  Joint& sprung = joints_[joint_index(joint)];
  require_kind(sprung.has_free_axis(), sprung, "hinge or slider, where it has a spring");
  if (spring) require_sound(*spring);
  if (spring) require_for_order_four({.i = 0, .j = 0, .d = 0, .spring = spring});
  if (spring) require_for_soft_steps({.i = 0, .j = 0, .spring = spring});
  const bool as_many_rows = spring.has_value() == sprung.spring.has_value();
  sprung.spring = spring;
  if (!as_many_rows) forget_the_last_step();
}

/// Returns the force or torque of a row, and of `more` on the motor's row [N s or N m s], on body j along the free
/// coordinate [N m or N].
template <int Dof>
double World<Dof>::along_free(int joint, int row, double more) const {
  if constexpr (Dof == 6) {
    const Row<Dof>* found = joint_row(joint, row);
    const Coordinate free = free_coordinate(joints_[joint_index(joint)], bodies_);
    if (found) return (std::copysign(1.0, found->Gj.dot(free.Gj)) * found->lambda + more) / h_;
  }
  return 0;
}

/// Adds λ times the mean speed of the rows of motors and springs, after the solve for V; and of all rows at kinematic
/// bodies, times the speed of these.
template <int Dof>
void World<Dof>::add_work_of_drives(const std::vector<Twist<Dof>>& V) {
  const std::vector<Twist<Dof>>& W = bodies_.motion.W;
  const auto add = [&](std::size_t joint, int of_joint) {
    const Row<Dof>& row = rows()[joint_rows_[joint] + static_cast<std::size_t>(of_joint)];
    const auto both = [&](int body) { return Twist<Dof>(2 * W[body] + bodies_.motion.Wf[body] + V[body]); };
    work_of_drives_ += row.lambda * (row.Gi.dot(both(row.i)) + row.Gj.dot(both(row.j))) / 2;
  };
  for (std::size_t n = 0; n < joints_.size(); ++n) {
    if (joints_[n].spring) add(n, joints_[n].spring_row());
    if (joints_[n].motor) add(n, joints_[n].rows() - 1);
  }
  if (kinematic_.empty()) return;
  for (const Row<Dof>& row : rows()) {
    if (bodies_.is_fixed(static_cast<std::size_t>(row.i))) work_of_drives_ -= row.lambda * row.Gi.dot(W[row.i]);
    if (bodies_.is_fixed(static_cast<std::size_t>(row.j))) work_of_drives_ -= row.lambda * row.Gj.dot(W[row.j]);
  }
}

/// Returns the sum of the forces of motors and springs, after the solve of a step of `h` [N]; that of a torque at the
/// longest arm of a dynamic body. Motors without a bound are left out.
template <int Dof>
double World<Dof>::force_of_drives(double h) const {
  double sum = 0;
  for (std::size_t n = 0; n < joints_.size(); ++n) {
    const Joint& joint = joints_[n];
    if (!joint.spring && !joint.motor) continue;
    const auto arm_of = [&](int body, const Vec3& p) {
      return bodies_.is_fixed(static_cast<std::size_t>(body)) ? 0 : p.norm();
    };
    const double longest = std::max(arm_of(joint.i, joint.p_i), arm_of(joint.j, joint.p_j));
    const double arm = joint.kind != JointKind::hinge ? 1 : longest > 0 ? longest : shapes_.smallest;
    const auto add = [&](int of_joint) {
      sum += std::abs(rows()[joint_rows_[n] + static_cast<std::size_t>(of_joint)].lambda) / (h * arm);
    };
    if (joint.spring) add(joint.spring_row());
    if (joint.motor && std::isfinite(joint.motor->strength)) add(joint.rows() - 1);
  }
  return sum;
}

/// Notes, after the solve, which part of each motor's row is its limit's.
template <int Dof>
void World<Dof>::part_limits_from_motors(double h) requires(Dof == 6) {
  if constexpr (Dof == 6) {
    const auto speed_after = [&](int body) -> Twist<6> {
      const Twist<6>& W = bodies_.motion.W[body];
      return settings_.soft_steps ? W : Twist<6>(W + bodies_.motion.Wf[body] + V_[body]);
    };
    for (std::size_t n = 0; n < joints_.size(); ++n) {
      Joint& joint = joints_[n];
      if (!joint.motor || !joint.limits) continue;
      const Row<6>& row = rows()[joint_rows_[n] + static_cast<std::size_t>(joint.rows() - 1)];
      const double speed = row.Gi.dot(speed_after(row.i)) + row.Gj.dot(speed_after(row.j));
      joint.taken_by_limit = impulse_of_limit(joint, row, speed, bodies_, h);
    }
  }
}

template <int Dof>
double World<Dof>::motor_force(int joint) const requires(Dof == 6) {
  const Joint& found = free_joint(joint);
  return found.motor ? along_free(joint, found.rows() - 1, -found.taken_by_limit) : 0;
}

template <int Dof>
double World<Dof>::limit_force(int joint) const requires(Dof == 6) {
  const Joint& found = free_joint(joint);
  return found.limits ? along_free(joint, found.holding_rows(), found.taken_by_limit) : 0;
}

template <int Dof>
double World<Dof>::spring_force(int joint) const requires(Dof == 6) {
  const Joint& found = free_joint(joint);
  return found.spring ? along_free(joint, found.spring_row()) : 0;
}

}  // namespace spook
