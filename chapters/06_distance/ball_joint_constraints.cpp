#include "06_distance/distance.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
std::array<Constraint<Dof>, 3> ball_joint_constraints(const Attachment& i, const Attachment& j,
                                                      const SpookParameters& spook) {
  // Eq. (6.4), (6.5), (6.6); what goes in and out, and in which units, is in distance.hpp.
  not_implemented("6.2 ball_joint_constraints", i, j, spook);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template std::array<Constraint<3>, 3> ball_joint_constraints<3>(const Attachment&, const Attachment&,
                                                                const SpookParameters&);
template std::array<Constraint<6>, 3> ball_joint_constraints<6>(const Attachment&, const Attachment&,
                                                                const SpookParameters&);

}  // namespace spook
