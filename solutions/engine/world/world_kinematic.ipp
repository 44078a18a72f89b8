// Static bodies with a velocity: kinematic bodies, which move with it, and conveyor belts, which stay where they are.
#include <algorithm>
#include <cmath>

#include "common/require.hpp"

namespace spook {

/// Returns the index of a static body. Throws std::invalid_argument for a dynamic body, and at integrator_order 4.
template <int Dof>
std::size_t World<Dof>::require_drivable(int body) const {
  const std::size_t i = index(body);
  if (!bodies_.is_fixed(i)) reject("body", body, "a static body");
  if (settings_.integrator_order == 4)
    throw std::invalid_argument("integrator_order must be 2 where static bodies have velocities, but is 4");
  return i;
}

template <int Dof>
void World<Dof>::drive(const Kinematic<Dof>& given, const Twist<Dof>& W) {
  bodies_.motion.W[index(given.body)] = W;
  std::erase_if(kinematic_, [&](const Kinematic<Dof>& one) { return one.body == given.body; });
  if (given.velocity || given.keyframes || !W.isZero(0)) kinematic_.push_back(given);
}

template <int Dof>
static Twist<Dof> without_rotation(const Vec3& v) {
  Twist<Dof> W = Twist<Dof>::Zero();
  W.template head<3>() = v;
  return W;
}

template <int Dof>
void World<Dof>::set_velocity(int body, const Vec3& v) {
  require_drivable(body);
  require_not_a_plane(body);
  require_all_finite("v", v);
  drive({.body = body}, without_rotation<Dof>(v));
}

// `if constexpr`, though `requires` says the same: clang before 16 compiles this for point masses, too.
template <int Dof>
void World<Dof>::set_velocity(int body, const Vec3& v, const Vec3& omega) requires(Dof == 6) {
  require_all_finite("omega", omega);
  set_velocity(body, v);
  if constexpr (Dof == 6) drive({.body = body}, (Twist<6>() << v, omega).finished());
}

template <int Dof>
void World<Dof>::set_surface_velocity(int body, const Vec3& v) {
  require_drivable(body);
  require_all_finite("v", v);
  for (const Plane& plane : shapes_.planes)
    if (plane.body == body && std::abs(plane.n.dot(v)) > 1e-9 * v.norm())
      reject("part of v along the plane's normal", plane.n.dot(v), "0");
  drive({.body = body, .moves = false}, without_rotation<Dof>(v));
}

template <int Dof>
void World<Dof>::set_velocity_function(int body, VelocityFunction<Dof> velocity) {
  require_drivable(body);
  require_not_a_plane(body);
  if (!velocity) throw std::invalid_argument("velocity must be a function, but is null");
  drive({.body = body, .velocity = std::move(velocity)}, Twist<Dof>::Zero());
}

template <int Dof>
void World<Dof>::set_keyframes(int body, Keyframes keyframes) {
  require_drivable(body);
  require_not_a_plane(body);
  drive({.body = body, .keyframes = std::move(keyframes)}, Twist<Dof>::Zero());
  place_on_keyframes();
}

template <int Dof>
void World<Dof>::place_on_keyframes() {
  for (const Kinematic<Dof>& one : kinematic_) {
    if (!one.keyframes) continue;
    const Keyframe now = one.keyframes->at(time_);
    bodies_.x[index(one.body)] = now.x;
    if constexpr (Dof == 6) bodies_.orientations.q[index(one.body)] = now.q;
  }
}

/// Sets the velocities of the step of `h` that begins now, where they depend on time.
template <int Dof>
void World<Dof>::update_kinematic_velocities(double h) {
  for (const Kinematic<Dof>& one : kinematic_) {
    const std::size_t i = index(one.body);
    Twist<Dof>& W = bodies_.motion.W[i];
    if (one.velocity) {
      W = one.velocity(time_ + h / 2);
      require_all_finite("velocity of body " + std::to_string(one.body), W);
    } else if (one.keyframes) {
      const Keyframe next = one.keyframes->at(time_ + h);
      W.template head<3>() = (next.x - bodies_.x[i]) / h;
      if constexpr (Dof == 6)
        W.template tail<3>() = angular_velocity_between(bodies_.orientations.q[i], next.q, h);
    }
  }
}

template <int Dof>
void World<Dof>::move_kinematic(double h) {
  for (const Kinematic<Dof>& one : kinematic_) {
    if (!one.moves) continue;
    const auto body = static_cast<std::size_t>(one.body);
    const Twist<Dof>& W = bodies_.motion.W[body];
    bodies_.x[body] = drift(bodies_.x[body], Vec3(W.template head<3>()), h);
    if constexpr (Dof == 6)
      bodies_.orientations.q[body] = update_exponential(bodies_.orientations.q[body], W.template tail<3>(), h);
  }
}

}  // namespace spook
