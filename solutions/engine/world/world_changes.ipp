// Changes of a world between its steps.
#include <algorithm>

#include "common/require.hpp"

namespace spook {

template <int Dof>
void World<Dof>::remove_body(int body) {
  const std::size_t i = index(body);
  bodies_.remove(i);
  shapes_.remove(body);
  materials_.remove(body);
  std::erase_if(kinematic_, [&](const Kinematic<Dof>& one) { return one.body == body; });
  for (Kinematic<Dof>& other : kinematic_) other.body -= other.body > body;
  const auto is_of_it = [&](const Joint& joint) { return joint.i == body || joint.j == body; };
  joints_.erase(std::remove_if(joints_.begin(), joints_.end(), is_of_it), joints_.end());
  for (Joint& joint : joints_) {
    joint.i -= joint.i > body;
    joint.j -= joint.j > body;
  }
  ++removals_;
  forget_the_last_step();
}

template <int Dof>
void World<Dof>::place(int body, const Vec3& x, const Vec3& v) {
  const std::size_t i = index(body);
  if (bodies_.is_fixed(i))
    throw std::invalid_argument("body " + std::to_string(body) + " is static: use move_fixed to move it");
  require_all_finite("x", x);
  require_all_finite("v", v);
  bodies_.x[i] = x;
  bodies_.motion.W[i].template head<3>() = v;
}

template <int Dof>
void World<Dof>::turn(int body, const Quat& q, const Vec3& omega) requires(Dof == 6) {
  const std::size_t i = index(body);
  if (bodies_.is_fixed(i))
    throw std::invalid_argument("body " + std::to_string(body) + " is static: it keeps its orientation");
  require_unit_length("q", q.norm());
  require_all_finite("omega", omega);
  if constexpr (Dof == 6) bodies_.orientations.q[i] = q.normalized();
  bodies_.motion.W[i].template tail<3>() = omega;
}

template <int Dof>
void World<Dof>::set_wrench(Wrench<Dof> wrench) {
  require_weight_in_box(settings_, settings_.force || wrench, materials_.rub());
  settings_.wrench = std::move(wrench);
  wrench_checked_ = false;
}

template <int Dof>
void World<Dof>::move_fixed(int body, const Vec3& x) {
  const std::size_t i = index(body);
  if (!bodies_.is_fixed(i)) reject("body", body, "a static body");
  require_not_a_plane(body);
  require_all_finite("x", x);
  bodies_.x[i] = x;
}

template <int Dof>
void World<Dof>::require_not_a_plane(int body) const {
  for (const Plane& plane : shapes_.planes)
    if (plane.body == body) reject("body", body, "another than a plane");
}

template <int Dof>
void World<Dof>::apply_central_impulse(int body, const Vec3& impulse) {
  const std::size_t i = index(body);
  require_all_finite("impulse", impulse);
  bodies_.motion.W[i].template head<3>() += bodies_.motion.inverse_mass[i].linear * impulse;
}

template <int Dof>
void World<Dof>::take_state_from(const World& other) {
  for (std::size_t i = 0; i < std::min(bodies_.size(), other.bodies_.size()); ++i) {
    const auto is_this = [&](const Kinematic<Dof>& one) { return one.body == static_cast<int>(i); };
    const bool is_static = bodies_.is_fixed(i) && std::none_of(kinematic_.begin(), kinematic_.end(), is_this);
    if (is_static || bodies_.is_fixed(i) != other.bodies_.is_fixed(i)) continue;
    bodies_.x[i] = other.bodies_.x[i];
    bodies_.motion.W[i] = other.bodies_.motion.W[i];
    if constexpr (Dof == 6) bodies_.orientations.q[i] = other.bodies_.orientations.q[i];
  }
  time_ = other.time_;
  if (settings_.integrator_order == other.settings_.integrator_order)
    h_ = other.h_;  // velocities lag by half of it
  place_on_keyframes();
  if (joints_.size() != other.joints_.size()) return;
  last_impulses_ = other.last_impulses_;
  for (const std::size_t hinge : hinges_) joints_[hinge].angle = other.joints_[hinge].angle;
  for (std::size_t n = 0; n < joints_.size(); ++n)
    joints_[n].recovered = !settings_.soft_steps && other.joints_[n].recovered;
}

}  // namespace spook
