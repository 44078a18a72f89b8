#include "scenes/balance.hpp"

#include <algorithm>

#include "scenes/scene.hpp"

namespace spook {

double largest_unbalanced(const World<6>& world, double radius, double h) {
  const Bodies<6>& bodies = world.bodies();
  const bool soft = world.settings().soft_steps.has_value();
  const double h_part = h / world.parts();
  std::vector<Vec3> force = world.forces(), torque(force.size(), Vec3::Zero());
  for (int c = 0; c < static_cast<int>(world.contacts().size()); ++c) {
    const Contact& contact = world.contacts()[static_cast<std::size_t>(c)];
    const Vec3 friction = (world.impulse(c) - world.lambda(c) * contact.n) / h_part;
    const double push =
        soft ? world.lambda(c) / h_part : world.contact_stiffness() * std::max(0.0, -contact.gap);
    const Vec3 on_j = push * contact.n + friction;
    const std::size_t i = world.index(contact.i), j = world.index(contact.j);
    force[j] += on_j;
    torque[j] += contact.r_j.cross(on_j);
    force[i] -= on_j;
    torque[i] -= contact.r_i.cross(on_j);
  }
  double most = 0;
  for (std::size_t b = 0; b < force.size(); ++b)
    if (!bodies.is_fixed(b)) most = larger(most, larger(force[b].norm(), torque[b].norm() / radius));
  return most;
}

}  // namespace spook
