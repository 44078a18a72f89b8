// Wrong: leaves the bounds of a contact, 0 and infinity.
// Killed by: FrictionConstraints.AreBoundedOnBothSides
// Says: nothing would ever slide
#include "05_friction_box/friction_box.hpp"

namespace spook {

template <int Dof>
static Constraint<Dof> along(const Vec3& t, Contact contact, const SpookParameters& spook) {
  contact.n = t;
  const ContactJacobian G = contact_jacobian(contact);
  return {
      .i = contact.i, .j = contact.j, .Gi = G.Gi.head<Dof>(), .Gj = G.Gj.head<Dof>(), .gap = 0, .spook = spook};
}

template <int Dof>
std::array<Constraint<Dof>, 2> friction_constraints(const Contact& contact, const Tangents& tangents, double,
                                                    const SpookParameters& spook) {
  return {along<Dof>(tangents.t1, contact, spook), along<Dof>(tangents.t2, contact, spook)};
}

template std::array<Constraint<3>, 2> friction_constraints<3>(const Contact&, const Tangents&, double,
                                                              const SpookParameters&);
template std::array<Constraint<6>, 2> friction_constraints<6>(const Contact&, const Tangents&, double,
                                                              const SpookParameters&);

}  // namespace spook
