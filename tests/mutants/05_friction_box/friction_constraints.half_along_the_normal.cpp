// Wrong: computes the torque with the normal.
// Killed by: FrictionConstraints.PointAlongTheTangents
// Says: the angular one still along n
#include "05_friction_box/friction_box.hpp"

namespace spook {

template <int Dof>
static Constraint<Dof> along(const Vec3& t, const Contact& contact, double bound, const Spook& spook) {
  Twist<6> Gi, Gj;
  Gi << -t, -contact.r_i.cross(contact.n);
  Gj << t, contact.r_j.cross(contact.n);
  return {.i = contact.i,
          .j = contact.j,
          .Gi = Gi.head<Dof>(),
          .Gj = Gj.head<Dof>(),
          .gap = 0,
          .spook = spook,
          .lo = -bound,
          .hi = bound};
}

template <int Dof>
std::array<Constraint<Dof>, 2> friction_constraints(const Contact& contact, const Tangents& tangents,
                                                    double bound, const Spook& spook) {
  return {along<Dof>(tangents.t1, contact, bound, spook), along<Dof>(tangents.t2, contact, bound, spook)};
}

template std::array<Constraint<3>, 2> friction_constraints<3>(const Contact&, const Tangents&, double,
                                                              const Spook&);
template std::array<Constraint<6>, 2> friction_constraints<6>(const Contact&, const Tangents&, double,
                                                              const Spook&);

}  // namespace spook
