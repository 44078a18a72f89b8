#include "05_friction_box/friction_box.hpp"

namespace spook {

template <int Dof>
static Constraint<Dof> along(const Vec3& t, const Contact& contact, double bound,
                             const SpookParameters& spook) {
  // Eq. (3.3), which holds for any direction. contact_jacobian would need a copy of the contact, with t for n.
  return {.i = contact.i,
          .j = contact.j,
          .Gi = twist(-t, -contact.r_i.cross(t)).head<Dof>(),
          .Gj = twist(t, contact.r_j.cross(t)).head<Dof>(),
          .gap = 0,
          .spook = spook,
          .lo = -bound,  // Eq. (5.8)
          .hi = bound};
}

template <int Dof>
std::array<Constraint<Dof>, 2> friction_constraints(const Contact& contact, const Tangents& tangents,
                                                    double bound, const SpookParameters& spook) {
  return {along<Dof>(tangents.t1, contact, bound, spook), along<Dof>(tangents.t2, contact, bound, spook)};
}

template std::array<Constraint<3>, 2> friction_constraints<3>(const Contact&, const Tangents&, double,
                                                              const SpookParameters&);
template std::array<Constraint<6>, 2> friction_constraints<6>(const Contact&, const Tangents&, double,
                                                              const SpookParameters&);

}  // namespace spook
