#include "engine/rows.hpp"

#include <cassert>

#include "engine/spook_of.hpp"

namespace spook {

template <int Dof>
Constraint<Dof> contact_constraint(const Contact& contact, const Spook& spook) {
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

/// How many contacts there are from `first` on between the same two bodies.
static int contacts_of_pair(const std::vector<Contact>& contacts, std::size_t first) {
  std::size_t end = first;
  while (end < contacts.size() && contacts[end].i == contacts[first].i && contacts[end].j == contacts[first].j)
    ++end;
  return static_cast<int>(end - first);
}

/// Velocity of j's contact point relative to i's, that of the forces included.
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
void add_contact_rows(const std::vector<Contact>& contacts, double h, const Materials& materials,
                      const Friction& friction, const Motion<Dof>& motion, std::vector<Row<Dof>>& rows,
                      std::vector<Rubbing>& rubbing) {
  SpookOf spook_of(h);
  if (!materials.rub()) {
    for (const Contact& contact : contacts) {
      const Touching touching = materials.of(contact.i, contact.j);
      rows.push_back(make_row(contact_constraint<Dof>(contact, spook_of(touching.k, touching.d)), motion));
    }
    return;
  }
  const Spook rub = friction_parameters(h, friction.c);
  const auto bound = [&](const Contact& contact, double mu, int count) {
    if (friction.model != FrictionModel::box) return friction.model == FrictionModel::cone ? infinity : 0.0;
    const double mass = representative_mass(motion.inverse_mass[contact.i].linear,
                                            motion.inverse_mass[contact.j].linear, count);
    return friction_bound(mu, mass, std::abs(friction.gravity.dot(contact.n)), h);
  };
  for (std::size_t first = 0; first < contacts.size();) {
    const int count = contacts_of_pair(contacts, first);
    const Touching touching = materials.of(contacts[first].i, contacts[first].j);
    for (const std::size_t end = first + static_cast<std::size_t>(count); first < end; ++first) {
      const Contact& contact = contacts[first];
      if (friction.model != FrictionModel::box)
        rubbing.push_back({.normal = rows.size(), .mu = touching.friction});
      rows.push_back(make_row(contact_constraint<Dof>(contact, spook_of(touching.k, touching.d)), motion));
      const Tangents along = friction.sliding_tangents ? sliding_tangents(contact.n, slip(contact, motion),
                                                                          1e-3 * friction.gravity.norm() * h)
                                                       : tangents(contact.n);
      for (const Constraint<Dof>& row :
           friction_constraints<Dof>(contact, along, bound(contact, touching.friction, count), rub))
        rows.push_back(make_row(row, motion));
    }
  }
}

template Constraint<3> contact_constraint<3>(const Contact&, const Spook&);
template Constraint<6> contact_constraint<6>(const Contact&, const Spook&);
template void add_contact_rows<3>(const std::vector<Contact>&, double, const Materials&, const Friction&,
                                  const Motion<3>&, std::vector<Row<3>>&, std::vector<Rubbing>&);
template void add_contact_rows<6>(const std::vector<Contact>&, double, const Materials&, const Friction&,
                                  const Motion<6>&, std::vector<Row<6>>&, std::vector<Rubbing>&);

}  // namespace spook
