#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

SolveReport step_contacts(Simulation& simulation, const std::vector<Contact>& contacts, double h) {
  const SpookParameters spook = spook_parameters(h, simulation.k, simulation.d);
  const Motion<6> motion = motion_of(simulation, h);

  // Rows, from the present positions and velocities.
  std::vector<Row<6>> rows;
  for (const Contact& contact : contacts) {
    const ContactJacobian G = contact_jacobian(contact);
    rows.push_back(make_row<6>(
        {.i = contact.i, .j = contact.j, .Gi = G.Gi, .Gj = G.Gj, .gap = contact.gap, .spook = spook}, motion));
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
