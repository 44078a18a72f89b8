// Joints of a world: checks of new joints, and queries.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "common/require.hpp"
#include "engine/support/require_index.hpp"

namespace spook {

static void require_kind(bool right, const Joint& joint, const std::string& rule) {
  if (!right) throw std::invalid_argument("kind must be " + rule + ", but is " + name_of(joint.kind));
}

/// Throws std::invalid_argument for an invalid motor.
static void require_sound(const Motor& motor) {
  const Motion<6> at_rest{.inverse_mass = {{}, {}},
                          .W = {Twist<6>::Zero(), Twist<6>::Zero()},
                          .Wf = {Twist<6>::Zero(), Twist<6>::Zero()}};
  const Twist<6> G = Twist<6>::Zero();
  motor_row({.i = 0, .j = 1, .Gi = G, .Gj = G, .value = 0}, motor, 1, at_rest);
}

template <int Dof>
int World<Dof>::add_joint(const Joint& given) {
  Joint joint = given;
  const std::size_t i = index(joint.i), j = index(joint.j);
  if (i == j) reject("joint's j", joint.j, "another body than its i");
  if (bodies_.is_fixed(i) && bodies_.is_fixed(j))
    reject("joint's j", joint.j, "a body that moves, as i does not");
  require_all_finite("p_i", joint.p_i);
  require_all_finite("p_j", joint.p_j);
  if constexpr (Dof == 3) {
    if (!joint.p_i.isZero(0)) reject("|p_i|", joint.p_i.norm(), "0 for a point mass");
    if (!joint.p_j.isZero(0)) reject("|p_j|", joint.p_j.norm(), "0 for a point mass");
  }
  joint.has_default_k = !joint.k && !settings_.k;
  joint.has_default_k_turn = joint.has_default_k && !joint.k_turn;
  if (!joint.k) joint.k = settings_.k.value_or(1e6);  // a step computes the default
  if (!joint.d) joint.d = settings_.d.value_or(settings_.integrator_order == 4 ? 0 : relaxation_of_joints);
  const SpookParameters spook = spook_parameters(1, *joint.k, *joint.d);
  if (joint.length && joint.kind == JointKind::rope) {
    require_positive("length", *joint.length);
    if (!joint.limit_d) joint.limit_d = relaxation_of_contacts;
    require_not_negative("limit_d", *joint.limit_d);
  } else if (joint.length) {
    if (joint.kind == JointKind::ball) joint.kind = JointKind::distance;
    require_kind(joint.kind == JointKind::distance, joint, "distance or rope, where it has a length");
    distance_constraint<Dof>(attachment(joint.i, joint.p_i, bodies_), attachment(joint.j, joint.p_j, bodies_),
                             *joint.length, spook);
  }
  require_kind(joint.length || !joint.needs_length(), joint, "another than distance or rope, without a length");
  const bool leaves_free = joint.has_free_axis();
  if (joint.limits) require_kind(leaves_free, joint, "hinge or slider, where it has limits");
  if (joint.spring) require_kind(leaves_free, joint, "hinge or slider, where it has a spring");
  if (joint.motor) require_kind(leaves_free, joint, "hinge or slider, where it has a motor");
  if (joint.is_guided()) complete(joint);
  require_for_order_four(joint);
  require_for_soft_steps(joint);
  joints_.push_back(joint);
  joint_rows_.push_back(next_joint_row_);
  next_joint_row_ += static_cast<std::size_t>(joint.rows());
  if (joint.kind == JointKind::hinge) hinges_.push_back(joints_.size() - 1);
  return static_cast<int>(joints_.size()) - 1;
}

/// Rows of springs and ropes depend on velocities, which the rows of soft steps do not contain.
template <int Dof>
void World<Dof>::require_for_soft_steps(const Joint& joint) const {
  if (!settings_.soft_steps) return;
  if (joint.spring) reject("spring's stiffness", joint.spring->stiffness, "left out with soft_steps");
  require_kind(joint.kind != JointKind::rope, joint, "another than rope with soft_steps");
}

/// Fills in the defaults of a hinge, slider or weld.
template <int Dof>
void World<Dof>::complete(Joint& joint) const {
  require_kind(Dof == 6, joint, "ball, distance or rope for point masses");
  if constexpr (Dof == 6) {
    const std::vector<Quat>& q = bodies_.orientations.q;
    require_unit_length("axis", joint.axis.norm());
    if (joint.rest) require_unit_length("rest", joint.rest->norm());
    if (!joint.rest) joint.rest = (q[index(joint.i)].conjugate() * q[index(joint.j)]).normalized();
    if (!joint.k_turn) joint.k_turn = joint.k;
    require_positive("k_turn", *joint.k_turn);
    if (joint.limits) {
      const JointLimits& limits = *joint.limits;
      for (const auto& [name, value] : {std::pair("lower", limits.lower), std::pair("upper", limits.upper)})
        if (std::isnan(value)) reject(name, value, "a number");
      if (!(limits.lower < limits.upper)) {
        std::ostringstream lower;
        lower << limits.lower;
        reject("upper", limits.upper,
               "more than lower, which is " + lower.str() +
                   (limits.lower == limits.upper ? "; use a weld to lock a joint" : ""));
      }
      if (!joint.limit_d) joint.limit_d = relaxation_of_contacts;
      require_not_negative("limit_d", *joint.limit_d);
    }
    if (joint.spring) require_sound(*joint.spring);
    if (joint.motor) require_sound(*joint.motor);
    require_finite("angle", joint.angle);
    if (joint.kind == JointKind::hinge) joint.angle = free_coordinate(joint, bodies_).value;
  }
}

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

template <int Dof>
void World<Dof>::remove_joint(int joint) {
  joints_.erase(joints_.begin() + static_cast<std::ptrdiff_t>(joint_index(joint)));
  forget_the_last_step();
}

/// Clears the results of the last step, since rows have new indices.
template <int Dof>
void World<Dof>::forget_the_last_step() {
  force_of_drives_ = 0;
  joint_rows_.clear();
  next_joint_row_ = 0;
  hinges_.clear();
  for (Joint& joint : joints_) {
    joint.taken_by_limit = 0;
    if (joint.kind == JointKind::hinge) hinges_.push_back(joint_rows_.size());
    joint_rows_.push_back(next_joint_row_);
    next_joint_row_ += static_cast<std::size_t>(joint.rows());
  }
  forget_contacts_and_rows();
  impacts_.clear();
  forces_.clear();
  torques_.clear();
  V_.clear();
  solved_ = {.history = {}, .converged = true};
  pairs_ = 0;
  work_of_drives_ = 0;
  start_ = {};
}

template <int Dof>
void World<Dof>::forget_contacts_and_rows() {
  contacts_.clear();
  constraints_.clear();
  recovered_.clear();
}

template <int Dof>
std::size_t World<Dof>::joint_index(int joint) const {
  return require_index("joint", joint, joints_.size());
}

template <int Dof>
const Row<Dof>* World<Dof>::joint_row(int joint, int row) const {
  const std::size_t j = joint_index(joint);
  if (row < 0 || row >= joints_[j].rows()) reject("row", row, "below " + std::to_string(joints_[j].rows()));
  const std::size_t r = joint_rows_[j] + static_cast<std::size_t>(row);
  return r < constraints_.joint_rows() ? &rows()[r] : nullptr;  // a new joint had no rows
}

template <int Dof>
double World<Dof>::joint_lambda(int joint, int row) const {
  const Row<Dof>* found = joint_row(joint, row);
  return found ? found->lambda : 0;
}

template <int Dof>
Vec3 World<Dof>::joint_force(int joint) const {
  const std::size_t j = joint_index(joint);
  Vec3 impulse = Vec3::Zero();
  for (int k = 0; k < joints_[j].rows(); ++k) {
    const std::size_t row = joint_rows_[j] + static_cast<std::size_t>(k);
    if (row < constraints_.joint_rows()) impulse += rows()[row].lambda * rows()[row].Gj.template head<3>();
  }
  return h_ > 0 ? Vec3(impulse / h_) : impulse;
}

template <int Dof>
Vec3 World<Dof>::joint_torque(int joint) const requires(Dof == 6) {
  Vec3 impulse = Vec3::Zero();
  for (int k = 0; k < joints_[joint_index(joint)].rows(); ++k) {
    const Row<Dof>* row = joint_row(joint, k);
    if (row && row->Gj.template head<3>().isZero(0)) impulse += row->lambda * row->Gj.template tail<3>();
  }
  return h_ > 0 ? Vec3(impulse / h_) : impulse;
}

/// Returns a joint with a free coordinate. Throws std::invalid_argument for other joints.
template <int Dof>
const Joint& World<Dof>::free_joint(int joint) const {
  const Joint& found = joints_[joint_index(joint)];
  require_kind(found.has_free_axis(), found, "hinge or slider");
  return found;
}

// `if constexpr`, though `requires` says the same: clang before 16 compiles these for point masses, too.
template <int Dof>
double World<Dof>::joint_position(int joint) const requires(Dof == 6) {
  if constexpr (Dof == 6) return free_coordinate(free_joint(joint), bodies_).value;
  return 0;
}

template <int Dof>
double World<Dof>::joint_speed(int joint) const requires(Dof == 6) {
  if constexpr (Dof == 6) {
    const Coordinate free = free_coordinate(free_joint(joint), bodies_);
    return free.Gi.dot(bodies_.motion.W[index(free.i)]) + free.Gj.dot(bodies_.motion.W[index(free.j)]);
  }
  return 0;
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
