#include "07_impacts/impacts.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

template <int Dof>
ImpactReport resolve_impacts(const std::vector<Contact>& contacts, const ImpactLaw& law, Motion<Dof>& motion) {
  // Eq. (7.1), (7.10); what goes in and out, and in which units, is in impacts.hpp.
  not_implemented("7.8 resolve_impacts", contacts, law, motion);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template ImpactReport resolve_impacts<3>(const std::vector<Contact>&, const ImpactLaw&, Motion<3>&);
template ImpactReport resolve_impacts<6>(const std::vector<Contact>&, const ImpactLaw&, Motion<6>&);

}  // namespace spook
