#include "engine/constraints/contact_rows.hpp"

#include <cassert>
#include <new>

#include "engine/constraints/parameter_cache.hpp"
#include "engine/support/parallel_for.hpp"

namespace spook {

template <int Dof>
Constraint<Dof> contact_constraint(const Contact& contact, const SpookParameters& spook) {
  assert(contact.i != contact.j && "a body has no contact with itself");
  const ContactJacobian G = contact_jacobian(contact);
  return {.i = contact.i,
          .j = contact.j,
          .Gi = G.Gi.head<Dof>(),
          .Gj = G.Gj.head<Dof>(),
          .gap = contact.gap,
          .spook = spook,
          .lo = 0,
          .hi = infinity};
}

/// The number of consecutive contacts between the two bodies of contact c.
static int contacts_of_pair(const std::vector<Contact>& contacts, std::size_t c) {
  const auto of_pair = [&](std::size_t other) {
    return contacts[other].i == contacts[c].i && contacts[other].j == contacts[c].j;
  };
  std::size_t first = c, end = c + 1;
  while (first > 0 && of_pair(first - 1)) --first;
  while (end < contacts.size() && of_pair(end)) ++end;
  return static_cast<int>(end - first);
}

/// Velocity of j's contact point relative to i's, with the velocity change by forces included.
static Vec3 slip(const Contact& contact, const Motion<3>& motion) {
  const auto v = [&](int body) { return motion.W[body] + motion.Wf[body]; };
  return v(contact.j) - v(contact.i);
}

static Vec3 slip(const Contact& contact, const Motion<6>& motion) {
  const auto v = [&](int body, const Vec3& r) {
    const Twist<6> W = motion.W[body] + motion.Wf[body];
    return Vec3(W.head<3>() + W.tail<3>().cross(r));
  };
  return v(contact.j, contact.r_j) - v(contact.i, contact.r_i);
}

template <int Dof>
void set_contact_rows(const std::vector<Contact>& contacts, double h, const Materials& materials,
                      const Friction& friction, const Motion<Dof>& motion, int threads,
                      ConstraintSet<Dof>& constraints) {
  const bool rub = materials.rub(), box = friction.model == FrictionModel::box;
  const SpookParameters of_friction = rub ? friction_parameters(h, friction.c) : SpookParameters{};
  const auto bound = [&](const Contact& contact, double mu, int count) {
    if (!box) return friction.model == FrictionModel::cone ? infinity : 0.0;
    const double mass = representative_mass(motion.inverse_mass[contact.i].linear,
                                            motion.inverse_mass[contact.j].linear, count);
    return friction_bound(mu, mass, std::abs(friction.gravity.dot(contact.n)), h);
  };
  constraints.rows_per_contact = rub ? 3 : 1;
  std::vector<Row<Dof>>& rows = constraints.rows;
  rows.resize(constraints.normal_row(contacts.size()));
  constraints.friction.resize(rub && !box ? contacts.size() : 0);
  // Built in place, without a copy.
  const auto make_at = [&](std::size_t k, const Constraint<Dof>& constraint) {
    new (&rows[k]) Row<Dof>(make_row(constraint, motion));
  };

  parallel_for(threads, contacts.size(), [&](std::size_t, std::size_t first, std::size_t end) {
    ParameterCache spook_of(h);
    PairMaterial touching{};
    Tangents along{};
    int count = 0;  // number of contacts of the pair
    double limit = 0;
    for (std::size_t c = first; c < end; ++c) {
      const Contact& contact = contacts[c];
      const bool same_pair = c > first && contact.i == contacts[c - 1].i && contact.j == contacts[c - 1].j;
      if (!same_pair) {
        touching = materials.of(contact.i, contact.j);
        if (rub) count = contacts_of_pair(contacts, c);
      }
      const std::size_t normal = constraints.normal_row(c);
      make_at(normal, contact_constraint<Dof>(contact, spook_of(touching.k, touching.d)));
      if (!rub) continue;
      // Contacts of two boxes usually share one normal, and so these tangents.
      const bool same_normal = same_pair && contact.n == contacts[c - 1].n;
      if (!same_normal) limit = bound(contact, touching.friction, count);
      if (friction.sliding_tangents)
        along = sliding_tangents(contact.n, slip(contact, motion), 1e-3 * friction.gravity.norm() * h);
      else if (!same_normal)
        along = tangents(contact.n);
      const auto tangential = friction_constraints<Dof>(contact, along, limit, of_friction);
      for (std::size_t t = 0; t < tangential.size(); ++t) make_at(normal + 1 + t, tangential[t]);
      if (!box) constraints.friction[c] = {.normal = normal, .mu = touching.friction};
    }
  });
}

template Constraint<3> contact_constraint<3>(const Contact&, const SpookParameters&);
template Constraint<6> contact_constraint<6>(const Contact&, const SpookParameters&);
template void set_contact_rows<3>(const std::vector<Contact>&, double, const Materials&, const Friction&,
                                  const Motion<3>&, int, ConstraintSet<3>&);
template void set_contact_rows<6>(const std::vector<Contact>&, double, const Materials&, const Friction&,
                                  const Motion<6>&, int, ConstraintSet<6>&);

}  // namespace spook
