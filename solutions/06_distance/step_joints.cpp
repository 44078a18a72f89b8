#include <algorithm>

#include "06_distance/distance.hpp"

namespace spook {

/// N, the number of contacts between the same two bodies.
static int contacts_of_pair(const std::vector<Contact>& contacts, const Contact& one) {
  return static_cast<int>(std::count_if(contacts.begin(), contacts.end(), [&](const Contact& other) {
    return other.i == one.i && other.j == one.j;
  }));
}

static Attachment attachment(const Simulation& simulation, int body, const Vec3& p) {
  const RigidBody& holding = simulation.bodies[body];
  return {.body = body, .x = holding.x, .r = holding.q * p};  // Eq. (6.1)
}

static void add_joint_rows(const Simulation& simulation, double h, const Motion<6>& motion,
                           std::vector<Row<6>>& rows) {
  for (const PointJoint& joint : simulation.joints) {
    const SpookParameters spook = spook_parameters(h, joint.k, joint.d);
    const Attachment i = attachment(simulation, joint.i, joint.p_i);
    const Attachment j = attachment(simulation, joint.j, joint.p_j);
    if (joint.length != 0)
      rows.push_back(make_row(distance_constraint<6>(i, j, joint.length, spook), motion));
    else
      for (const Constraint<6>& along : ball_joint_constraints<6>(i, j, spook))
        rows.push_back(make_row(along, motion));
  }
}

static void add_contact_rows(const Simulation& simulation, const std::vector<Contact>& contacts, double h,
                             const Motion<6>& motion, std::vector<Row<6>>& rows) {
  const SpookParameters spook = spook_parameters(h, simulation.k, simulation.d);
  const SpookParameters of_friction = friction_parameters(h, simulation.viscosity);
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
}

SolveReport step_joints(Simulation& simulation, const std::vector<Contact>& contacts, double h) {
  const Motion<6> motion = motion_of(simulation, h);
  std::vector<Row<6>> rows;
  add_joint_rows(simulation, h, motion, rows);
  add_contact_rows(simulation, contacts, h, motion, rows);

  std::vector<Twist<6>> V(simulation.bodies.size(), Twist<6>::Zero());
  SolveReport report = solve(rows, V, {.max_sweeps = simulation.max_sweeps, .tolerance = simulation.tolerance});

  for (std::size_t b = 0; b < V.size(); ++b) add_twist(simulation.bodies[b], V[b]);
  step_free(simulation, h);
  return report;
}

}  // namespace spook
