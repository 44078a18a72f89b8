#include <algorithm>

#include "09_better_friction/better_friction.hpp"
#include "common/require.hpp"

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

static void resolve(Simulation& simulation, const std::vector<Contact>& contacts, double h) {
  Motion<6> motion = motion_of(simulation, h);
  const ImpactLaw law{.restitution = simulation.restitution,
                      .friction = simulation.mu,
                      .threshold = simulation.gravity.norm() * h};
  resolve_impacts(contacts, law, motion);
  for (std::size_t b = 0; b < motion.W.size(); ++b) {
    simulation.bodies[b].v = motion.W[b].head<3>();
    simulation.bodies[b].omega = motion.W[b].tail<3>();
  }
}

static void add_joint_rows(const Simulation& simulation, double h, StepRows& step) {
  for (const PointJoint& joint : simulation.joints) {
    const SpookParameters spook = spook_parameters(h, joint.k, joint.d);
    const Attachment i = attachment(simulation, joint.i, joint.p_i);
    const Attachment j = attachment(simulation, joint.j, joint.p_j);
    if (joint.length != 0)
      step.rows.push_back(make_row(distance_constraint<6>(i, j, joint.length, spook), step.motion));
    else
      for (const Constraint<6>& along : ball_joint_constraints<6>(i, j, spook))
        step.rows.push_back(make_row(along, step.motion));
  }
}

static void add_contact_rows(const Simulation& simulation, const std::vector<Contact>& contacts, double h,
                             StepRows& step) {
  const SpookParameters spook = spook_parameters(h, simulation.k, simulation.d);
  const SpookParameters of_friction = friction_parameters(h, simulation.viscosity);
  for (const Contact& contact : contacts) {
    const ContactJacobian G = contact_jacobian(contact);
    if (simulation.mu != 0) step.friction.push_back({.normal = step.rows.size(), .mu = simulation.mu});
    step.rows.push_back(make_row<6>(
        {.i = contact.i, .j = contact.j, .Gi = G.Gi, .Gj = G.Gj, .gap = contact.gap, .spook = spook},
        step.motion));
    if (simulation.mu == 0) continue;
    const double mass =
        representative_mass(step.motion.inverse_mass[contact.i].linear,
                            step.motion.inverse_mass[contact.j].linear, contacts_of_pair(contacts, contact));
    const double bound = friction_bound(simulation.mu, mass, std::abs(simulation.gravity.dot(contact.n)), h);
    for (const Constraint<6>& along : friction_constraints<6>(contact, tangents(contact.n), bound, of_friction))
      step.rows.push_back(make_row(along, step.motion));
  }
}

StepRows step_rows(Simulation& simulation, const std::vector<Contact>& contacts, double h) {
  require_positive("h", h);
  if (simulation.restitution != 0) resolve(simulation, contacts, h);
  StepRows step{.motion = motion_of(simulation, h), .rows = {}, .friction = {}};
  add_joint_rows(simulation, h, step);
  add_contact_rows(simulation, contacts, h, step);
  return step;
}

}  // namespace spook
