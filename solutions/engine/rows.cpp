#include "engine/rows.hpp"

#include <cassert>

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

template <int Dof>
void build_contact_rows(const std::vector<Contact>& contacts, const Spook& spook, const Motion<Dof>& motion,
                        std::vector<Row<Dof>>& rows) {
  rows.clear();
  for (const Contact& contact : contacts)
    rows.push_back(make_row(contact_constraint<Dof>(contact, spook), motion));
}

template Constraint<3> contact_constraint<3>(const Contact&, const Spook&);
template Constraint<6> contact_constraint<6>(const Contact&, const Spook&);
template void build_contact_rows<3>(const std::vector<Contact>&, const Spook&, const Motion<3>&,
                                    std::vector<Row<3>>&);
template void build_contact_rows<6>(const std::vector<Contact>&, const Spook&, const Motion<6>&,
                                    std::vector<Row<6>>&);

}  // namespace spook
