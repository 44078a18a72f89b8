#include "engine/diagnostics/spring_energy.hpp"

namespace spook {

template <int Dof>
double spring_energy(const World<Dof>& world, double h) {
  if (world.settings().integrator_order == 4) return 0;
  const double part = h / world.parts();  // to which λ belongs
  const auto held = [part](double lambda, double k) { return lambda * lambda / (2 * part * part * k); };
  const auto joints = static_cast<int>(world.joints().size()),
             contacts = static_cast<int>(world.contacts().size());
  double energy = 0;
  for (int joint = 0; joint < joints; ++joint) {
    const Joint& pulled = world.joints()[static_cast<std::size_t>(joint)];
    for (int row = 0; row < pulled.rows(); ++row)
      energy += held(world.joint_lambda(joint, row), pulled.stiffness(row));
    if constexpr (Dof == 6)
      if (pulled.spring) {
        const double drawn = world.joint_position(joint) - pulled.spring->rest;
        energy += pulled.spring->stiffness * drawn * drawn / 2;
      }
  }
  for (int c = 0; c < contacts; ++c) {
    const Contact& contact = world.contacts()[static_cast<std::size_t>(c)];
    energy += held(world.lambda(c), world.materials().of(contact.i, contact.j).k);
  }
  return energy;
}

template double spring_energy<3>(const World<3>&, double);
template double spring_energy<6>(const World<6>&, double);

}  // namespace spook
