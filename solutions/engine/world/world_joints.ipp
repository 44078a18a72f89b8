// Joints of a world: checks of new joints, and queries.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "common/require.hpp"
#include "engine/support/require_index.hpp"

namespace spook {

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
  last_impulses_ = {};
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

}  // namespace spook
