// Wrong: makes every friction row rigid.
// Killed by: FrictionConstraints.CarryTheRestOver
// Says: this row is rigid, and nothing creeps
#include "05_friction_box/friction_box.hpp"

namespace spook {

template <int Dof>
static Constraint<Dof> along(const Vec3& t, Contact contact, double bound) {
  contact.n = t;
  const ContactJacobian G = contact_jacobian(contact);
  return {.i = contact.i,
          .j = contact.j,
          .Gi = G.Gi.head<Dof>(),
          .Gj = G.Gj.head<Dof>(),
          .gap = 0,
          .spook = {.a = 0, .b = 1, .Sigma = 0},
          .lo = -bound,
          .hi = bound};
}

template <int Dof>
std::array<Constraint<Dof>, 2> friction_constraints(const Contact& contact, const Tangents& tangents,
                                                    double bound, const Spook&) {
  return {along<Dof>(tangents.t1, contact, bound), along<Dof>(tangents.t2, contact, bound)};
}

template std::array<Constraint<3>, 2> friction_constraints<3>(const Contact&, const Tangents&, double,
                                                              const Spook&);
template std::array<Constraint<6>, 2> friction_constraints<6>(const Contact&, const Tangents&, double,
                                                              const Spook&);

}  // namespace spook
