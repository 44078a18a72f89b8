#include "03_single_contact/single_contact.hpp"

namespace spook {

void step_touching(Simulation& simulation, const Contact& contact, double h) {
  const SpookParameters spook = spook_parameters(h, simulation.k, simulation.d);
  RigidBody& i = simulation.bodies[contact.i];
  RigidBody& j = simulation.bodies[contact.j];
  const InverseMass<6> Minv_i = inverse_mass_of(i), Minv_j = inverse_mass_of(j);

  const ContactJacobian G = contact_jacobian(contact);
  const Mat3 K = collision_matrix(Minv_i, contact.r_i, Minv_j, contact.r_j);
  const double GW = G.Gi.dot(twist_of(i)) + G.Gj.dot(twist_of(j));
  const double GWf =
      G.Gi.dot(force_twist_of(i, simulation.gravity, h)) + G.Gj.dot(force_twist_of(j, simulation.gravity, h));
  const double lambda = contact_impulse(spook, contact.n.dot(K * contact.n), contact.gap, GW, GWf);

  // W <- W + M⁻¹ Gᵀ λ
  add_twist(i, lambda * Minv_i.times(G.Gi));
  add_twist(j, lambda * Minv_j.times(G.Gj));
  step_free(simulation, h);
}

}  // namespace spook
