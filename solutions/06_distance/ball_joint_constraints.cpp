#include "06_distance/distance.hpp"

namespace spook {

template <int Dof>
std::array<Constraint<Dof>, 3> ball_joint_constraints(const Attachment& i, const Attachment& j,
                                                      const SpookParameters& spook) {
  const Vec3 apart = (j.x + j.r) - (i.x + i.r);  // Eq. (6.5)
  std::array<Constraint<Dof>, 3> rows;
  for (int axis = 0; axis < 3; ++axis) {
    const Contact along{
        .i = i.body, .j = j.body, .n = Vec3::Unit(axis), .gap = apart[axis], .r_i = i.r, .r_j = j.r};
    const ContactJacobian G = contact_jacobian(along);  // Eq. (6.6)
    rows[static_cast<std::size_t>(axis)] = {.i = along.i,
                                            .j = along.j,
                                            .Gi = G.Gi.head<Dof>(),
                                            .Gj = G.Gj.head<Dof>(),
                                            .gap = along.gap,
                                            .spook = spook,
                                            .lo = -infinity,  // Eq. (6.4)
                                            .hi = infinity};
  }
  return rows;
}

template std::array<Constraint<3>, 3> ball_joint_constraints<3>(const Attachment&, const Attachment&,
                                                                const SpookParameters&);
template std::array<Constraint<6>, 3> ball_joint_constraints<6>(const Attachment&, const Attachment&,
                                                                const SpookParameters&);

}  // namespace spook
