#include "06_distance/distance.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

template <int Dof>
Constraint<Dof> distance_constraint(const Attachment& i, const Attachment& j, double length,
                                    const SpookParameters& spook) {
  // Eq. (6.1)-(6.4); what goes in and out, and in which units, is in distance.hpp.
  not_implemented("6.1 distance_constraint", i, j, length, spook);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template Constraint<3> distance_constraint<3>(const Attachment&, const Attachment&, double,
                                              const SpookParameters&);
template Constraint<6> distance_constraint<6>(const Attachment&, const Attachment&, double,
                                              const SpookParameters&);

}  // namespace spook
