#include "06_distance/distance.hpp"
#include "common/require.hpp"

namespace spook {

template <int Dof>
Constraint<Dof> distance_constraint(const Attachment& i, const Attachment& j, double length,
                                    const SpookParameters& spook) {
  require_positive("length", length);
  const Vec3 apart = (j.x + j.r) - (i.x + i.r);
  const double distance = apart.norm();
  require_positive("distance", distance);

  const Contact along{.i = i.body,  // Eq. (6.2)
                      .j = j.body,
                      .n = apart / distance,
                      .gap = distance - length,
                      .r_i = i.r,
                      .r_j = j.r};
  const ContactJacobian G = contact_jacobian(along);  // Eq. (6.3)
  return {.i = along.i,
          .j = along.j,
          .Gi = G.Gi.head<Dof>(),
          .Gj = G.Gj.head<Dof>(),
          .gap = along.gap,
          .spook = spook,
          .lo = -infinity,  // Eq. (6.4)
          .hi = infinity};
}

template Constraint<3> distance_constraint<3>(const Attachment&, const Attachment&, double,
                                              const SpookParameters&);
template Constraint<6> distance_constraint<6>(const Attachment&, const Attachment&, double,
                                              const SpookParameters&);

}  // namespace spook
