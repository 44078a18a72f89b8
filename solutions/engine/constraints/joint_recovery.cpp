#include "engine/constraints/joint_recovery.hpp"

#include <algorithm>
#include <cmath>

#include "engine/bodies/conserved_quantities.hpp"
#include "engine/constraints/joint_rows.hpp"
#include "engine/constraints/mechanisms.hpp"

namespace spook {

static constexpr double share_of_energy = 1e-2, largest_gap = 0.05;  // of an arm, or rad

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

template <int Dof>
std::vector<RigidLimit> rigid_limits(const std::vector<Joint>& joints,
                                     const std::vector<std::size_t>& first_rows, const Bodies<Dof>& bodies,
                                     const Vec3& gravity, double h) {
  std::vector<RigidLimit> limits;
  for (std::size_t n = 0; n < joints.size(); ++n) {
    const Joint& joint = joints[n];
    const bool is_hinge = joint.kind == JointKind::hinge, is_rope = joint.kind == JointKind::rope;
    if (!(is_rope || joint.limits) || !(is_hinge ? joint.has_default_k_turn : joint.has_default_k)) continue;
    const double range = is_hinge ? 1 : is_rope ? *joint.length : joint.limits->upper - joint.limits->lower;
    const double swings = is_rope ? squared_speed(joint, bodies) * h / range + 1e-2 * gravity.norm() * h : 0;
    limits.push_back({.row = first_rows[n] + static_cast<std::size_t>(is_rope ? 0 : joint.holding_rows()),
                      .ignored = 1e-9 * (std::isfinite(range) ? range : 0) / h + swings});
    if constexpr (Dof == 6) {
      if (!joint.motor) continue;
      const double value = free_coordinate(joint, bodies).value;
      if (limits_motor(joint, value, h))
        limits.back().motor = {.row = first_rows[n] + static_cast<std::size_t>(joint.rows() - 1),
                               .speed = speed_without_return(joint, value, h)};
    }
  }
  return limits;
}

static bool is_held(const Joint& joint) {
  return joint.has_default_k && joint.kind != JointKind::rope;
}

/// Calls `each` with the rows that hold a joint without a k of its own.
template <class Each>
static void for_holding(const Joint& joint, std::size_t first_row, const Each& each) {
  if (!is_held(joint)) return;
  for (int k = 0; k < joint.holding_rows(); ++k)
    if (!joint.turns(k) || joint.has_default_k_turn) each(first_row + static_cast<std::size_t>(k));
}

template <int Dof>
static bool has_large_gap(const Joint& joint, const Bodies<Dof>& bodies) {
  const JointGap gap = gap_of(joint, bodies);
  const double arm = std::max({joint.p_i.norm(), joint.p_j.norm(), joint.length.value_or(0)});
  return gap.apart.norm() > largest_gap * arm || gap.turned.norm() > largest_gap;
}

/// Sets the work of a mechanism to 0 if it is at most `share_of_energy` of the mechanism's kinetic energy. Returns true
/// if any work is left.
template <int Dof, class Velocity>
static bool leave_with_work(Mechanisms<Dof>& mechanisms, const Bodies<Dof>& bodies, std::vector<double>& work,
                            const Velocity& velocity_of) {
  std::vector<double> T(bodies.size(), 0.0);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (const int number = mechanisms.of(static_cast<int>(i)); work[number] > 0)
      T[number] += kinetic_energy(bodies, i, velocity_of(i));
  bool any = false;
  for (std::size_t i = 0; i < T.size(); ++i) {
    if (work[i] > share_of_energy * T[i])
      any = true;
    else
      work[i] = 0;
  }
  return any;
}

template <int Dof>
std::vector<std::size_t> holding_rows_with_work(const std::vector<Joint>& joints,
                                                const std::vector<std::size_t>& first_rows,
                                                const std::vector<Row<Dof>>& rows, const Bodies<Dof>& bodies,
                                                const std::vector<Twist<Dof>>& V) {
  if (joints.empty()) return {};
  const Motion<Dof>& motion = bodies.motion;
  const auto after = [&](std::size_t i) -> Twist<Dof> { return motion.W[i] + motion.Wf[i] + V[i]; };
  const auto mean = [&](int i) -> Twist<Dof> { return motion.W[i] + 0.5 * (motion.Wf[i] + V[i]); };

  Mechanisms<Dof> mechanisms(joints, bodies);
  std::vector<double> work(bodies.size(), 0.0);
  for (std::size_t n = 0; n < joints.size(); ++n)
    for_holding(joints[n], first_rows[n], [&](std::size_t k) {
      const Row<Dof>& row = rows[k];
      work[mechanisms.of(joints[n])] += row.lambda * (row.Gi.dot(mean(row.i)) + row.Gj.dot(mean(row.j)));
    });
  const auto leaves_work = [&](const auto& velocity_of) {
    return leave_with_work(mechanisms, bodies, work, velocity_of);
  };
  if (!leaves_work([&](std::size_t i) -> Twist<Dof> { return motion.W[i]; }) ||
      !leaves_work([&](std::size_t i) -> Twist<Dof> { return motion.Wf[i]; }) || !leaves_work(after))
    return {};

  for (const Joint& joint : joints)
    if (is_held(joint) && has_large_gap(joint, bodies)) work[mechanisms.of(joint)] = 0;
  std::vector<std::size_t> found;
  for (std::size_t n = 0; n < joints.size(); ++n)
    if (work[mechanisms.of(joints[n])] > 0)
      for_holding(joints[n], first_rows[n], [&](std::size_t k) { found.push_back(k); });
  return found;
}

template std::vector<RigidLimit> rigid_limits<3>(const std::vector<Joint>&, const std::vector<std::size_t>&,
                                                 const Bodies<3>&, const Vec3&, double);
template std::vector<RigidLimit> rigid_limits<6>(const std::vector<Joint>&, const std::vector<std::size_t>&,
                                                 const Bodies<6>&, const Vec3&, double);
template std::vector<std::size_t> holding_rows_with_work<3>(const std::vector<Joint>&,
                                                            const std::vector<std::size_t>&,
                                                            const std::vector<Row<3>>&, const Bodies<3>&,
                                                            const std::vector<Twist<3>>&);
template std::vector<std::size_t> holding_rows_with_work<6>(const std::vector<Joint>&,
                                                            const std::vector<std::size_t>&,
                                                            const std::vector<Row<6>>&, const Bodies<6>&,
                                                            const std::vector<Twist<6>>&);

}  // namespace spook
