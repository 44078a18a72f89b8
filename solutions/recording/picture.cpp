#include "recording/picture.hpp"

#include "engine/diagnostics/spring_energy.hpp"

namespace spook {

template <int Dof>
Picture picture_of(const World<Dof>& world) {
  Picture picture{.bodies = std::vector<Appearance>(world.bodies().size()), .joints = world.joints()};
  const std::vector<Shape> shapes = world.shapes().by_body(picture.bodies.size());
  for (std::size_t i = 0; i < picture.bodies.size(); ++i)
    picture.bodies[i] = {.shape = shapes[i], .is_static = world.bodies().is_fixed(i)};
  for (const Plane& plane : world.shapes().planes) picture.bodies[world.index(plane.body)].plane = plane;
  return picture;
}

template <int Dof>
static Energy energy_of(const World<Dof>& world, double h) {
  const Bodies<Dof>& bodies = world.bodies();
  Energy energy;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.is_fixed(i)) continue;
    const Vec3 v = bodies.motion.W[i].template head<3>();
    energy.motion += bodies.mass[i] * v.squaredNorm() / 2;
    energy.weight -= bodies.mass[i] * world.settings().gravity.dot(bodies.x[i] - world.velocity_lag(h) * v);
    if constexpr (Dof == 6) {
      const Vec3 in_body = bodies.orientations.q[i].conjugate() * bodies.motion.W[i].template tail<3>();
      energy.turning += bodies.orientations.principal[i].dot(in_body.cwiseAbs2()) / 2;
    }
  }
  energy.springs = spring_energy(world, h);
  return energy;
}

template <int Dof>
Frame frame_of(const World<Dof>& world, double h) {
  const Bodies<Dof>& bodies = world.bodies();
  Frame frame;
  frame.time = world.time();
  frame.step = world.steps();
  frame.x = bodies.x;
  frame.energy = energy_of(world, h);
  for (const Twist<Dof>& W : bodies.motion.W) frame.v.push_back(W.template head<3>());
  if constexpr (Dof == 6) {
    frame.q = bodies.orientations.q;
    for (const Twist<Dof>& W : bodies.motion.W) frame.omega.push_back(W.template tail<3>());
  }
  const auto contacts = static_cast<int>(world.contacts().size());
  for (int c = 0; c < contacts; ++c) {
    const Contact& contact = world.contacts()[static_cast<std::size_t>(c)];
    frame.contacts.push_back({.i = contact.i,
                              .j = contact.j,
                              .point = world.x(contact.i) + contact.r_i,
                              .n = contact.n,
                              .gap = contact.gap,
                              .impulse = world.impulse(c)});
  }
  const auto joints = static_cast<int>(world.joints().size());
  for (int joint = 0; joint < joints; ++joint)
    for (int row = 0; row < world.joints()[static_cast<std::size_t>(joint)].rows(); ++row)
      frame.joint_impulses.push_back(world.joint_lambda(joint, row));
  return frame;
}

template Picture picture_of(const World<3>&);
template Picture picture_of(const World<6>&);
template Frame frame_of(const World<3>&, double);
template Frame frame_of(const World<6>&, double);

}  // namespace spook
