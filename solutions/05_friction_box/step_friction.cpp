#include <algorithm>

#include "05_friction_box/friction_box.hpp"

namespace spook {

/// N, the number of contacts between the same two bodies.
static int contacts_of_pair(const std::vector<Contact>& contacts, const Contact& one) {
  return static_cast<int>(std::count_if(contacts.begin(), contacts.end(), [&](const Contact& other) {
    return other.i == one.i && other.j == one.j;
  }));
}

SolveReport step_friction(Simulation& simulation, const std::vector<Contact>& contacts, double h) {
  const SpookParameters spook = spook_parameters(h, simulation.k, simulation.d);
  const SpookParameters of_friction = friction_parameters(h, simulation.viscosity);
  const Motion<6> motion = motion_of(simulation, h);

  // Rows: the normal of a contact, then its tangents.
  std::vector<Row<6>> rows;
  for (const Contact& contact : contacts) {
    const ContactJacobian G = contact_jacobian(contact);
    rows.push_back(make_row<6>(
        {.i = contact.i, .j = contact.j, .Gi = G.Gi, .Gj = G.Gj, .gap = contact.gap, .spook = spook}, motion));
    if (simulation.mu == 0) continue;
    const double mass =
        representative_mass(motion.inverse_mass[contact.i].linear, motion.inverse_mass[contact.j].linear,
                            contacts_of_pair(contacts, contact));
    const double bound = friction_bound(simulation.mu, mass, std::abs(simulation.gravity.dot(contact.n)), h);
    for (const Constraint<6>& along : friction_constraints<6>(contact, tangents(contact.n), bound, of_friction))
      rows.push_back(make_row(along, motion));
  }

  // Solve: V = M⁻¹ Gᵀ λ.
  std::vector<Twist<6>> V(simulation.bodies.size(), Twist<6>::Zero());
  SolveReport report = solve(rows, V, {.max_sweeps = simulation.max_sweeps, .tolerance = simulation.tolerance});

  // Integrate.
  for (std::size_t b = 0; b < V.size(); ++b) add_twist(simulation.bodies[b], V[b]);
  step_free(simulation, h);
  return report;
}

}  // namespace spook
