#include "scenes/hand.hpp"

#include "common/require.hpp"

namespace spook {

// Soft for any mass of the pulled body: its period of oscillation is a quarter of a second.
static constexpr double stiffness_of_mass = 640;  // [1/s²]
static constexpr double relaxation = 3;           // [steps]; for strong damping

template <int Dof>
bool HandIn<Dof>::pull(int body, const Vec3& point, const Vec3& to) {
  if (world_.bodies().is_fixed(world_.index(body))) reject("body", body, "a dynamic one");
  require_all_finite("point", point);
  require_all_finite("to", to);
  if (grip_ && grip_->body == body && grip_->point == point) {
    world_.move_fixed(*anchor_, to);
    return false;
  }
  let_go();
  if (!anchor_) {
    anchor_ = world_.add_fixed(to);
    later_.push_back({.body = *anchor_});
  }
  world_.move_fixed(*anchor_, to);
  const double mass = world_.bodies().mass[world_.index(body)];
  const Vec3 held = Dof == 3 ? Vec3::Zero() : point;
  const int joint =
      world_.add_joint({.i = *anchor_, .j = body, .p_j = held, .k = stiffness_of_mass * mass, .d = relaxation});
  grip_ = Grip{.body = body, .point = point, .joint = joint};
  return true;
}

template <int Dof>
bool HandIn<Dof>::let_go() {
  if (!grip_) return false;
  world_.remove_joint(grip_->joint);
  grip_.reset();
  return true;
}

template <int Dof>
void HandIn<Dof>::apply_central_impulse(int body, const Vec3& impulse) {
  world_.apply_central_impulse(body, impulse);
}

template <int Dof>
void HandIn<Dof>::drop(const Vec3& x, double radius, double mass) {
  require_positive("radius", radius);
  Body<Dof> ball;
  ball.x = x;
  ball.mass = mass;
  ball.radius = radius;
  if constexpr (Dof == 6) ball.principal = solid_sphere_moments(mass, radius);
  later_.push_back({.body = world_.add(ball), .radius = radius, .mass = mass});
}

template <int Dof>
bool HandIn<Dof>::take_over(const HandIn& other) {
  if (scene_bodies() != other.scene_bodies()) return false;
  for (const Later& later : other.later_) {
    const Vec3& x = other.world_.x(later.body);
    if (other.world_.bodies().is_fixed(static_cast<std::size_t>(later.body))) {
      anchor_ = world_.add_fixed(x);
      later_.push_back({.body = *anchor_});
    } else {
      drop(x, later.radius, later.mass);
    }
  }
  if (other.grip_) pull(other.grip_->body, other.grip_->point, other.world_.x(*other.anchor_));
  return true;
}

template class HandIn<3>;
template class HandIn<6>;

}  // namespace spook
