#include "05_friction_box/friction_box.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
std::array<Constraint<Dof>, 2> friction_constraints(const Contact& contact, const Tangents& tangents,
                                                    double bound, const SpookParameters& spook) {
  // Eq. (5.2), (5.3), (5.8); what goes in and out, and in which units, is in friction_box.hpp.
  not_implemented("5.5 friction_constraints", contact, tangents, bound, spook);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template std::array<Constraint<3>, 2> friction_constraints<3>(const Contact&, const Tangents&, double,
                                                              const SpookParameters&);
template std::array<Constraint<6>, 2> friction_constraints<6>(const Contact&, const Tangents&, double,
                                                              const SpookParameters&);

}  // namespace spook
