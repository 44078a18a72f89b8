// Static bodies with a velocity: kinematic bodies, which move with it, and conveyor belts, which stay where they are.
#include <algorithm>

#include "common/require.hpp"

namespace spook {

/// Returns a static body's index. Throws std::invalid_argument for another body.
template <int Dof>
std::size_t World<Dof>::static_body(int body) const {
  const std::size_t i = index(body);
  if (!bodies_.is_fixed(i)) reject("body", body, "a static one");
  if (settings_.integrator_order == 4)
    throw std::invalid_argument("integrator_order must be 2 where static bodies have velocities, but is 4");
  return i;
}

template <int Dof>
void World<Dof>::drive(int body, const Twist<Dof>& W, bool moves) {
  bodies_.motion.W[index(body)] = W;
  std::erase_if(kinematic_, [&](const Kinematic& one) { return one.body == body; });
  if (!W.isZero(0)) kinematic_.push_back({.body = body, .moves = moves});
}

template <int Dof>
static Twist<Dof> without_rotation(const Vec3& v) {
  Twist<Dof> W = Twist<Dof>::Zero();
  W.template head<3>() = v;
  return W;
}

template <int Dof>
void World<Dof>::set_velocity(int body, const Vec3& v) {
  static_body(body);
  require_not_a_plane(body);
  require_all_finite("v", v);
  drive(body, without_rotation<Dof>(v), true);
}

// `if constexpr`, though `requires` says the same: clang before 16 compiles this for point masses, too.
template <int Dof>
void World<Dof>::set_velocity(int body, const Vec3& v, const Vec3& omega) requires(Dof == 6) {
  require_all_finite("omega", omega);
  set_velocity(body, v);
  if constexpr (Dof == 6) drive(body, (Twist<6>() << v, omega).finished(), true);
}

template <int Dof>
void World<Dof>::set_surface_velocity(int body, const Vec3& v) {
  static_body(body);
  require_all_finite("v", v);
  drive(body, without_rotation<Dof>(v), false);
}

template <int Dof>
void World<Dof>::move_kinematic(double h) {
  for (const auto& [body, moves] : kinematic_) {
    if (!moves) continue;
    const Twist<Dof>& W = bodies_.motion.W[body];
    bodies_.x[body] = drift(bodies_.x[body], Vec3(W.template head<3>()), h);
    if constexpr (Dof == 6)
      bodies_.orientations.q[body] = update_exponential(bodies_.orientations.q[body], W.template tail<3>(), h);
  }
}

}  // namespace spook
