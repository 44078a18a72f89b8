#include "10_convergence/convergence.hpp"
#include "common/not_implemented.hpp"

namespace spook {

std::vector<int> match_contacts(const std::vector<Contact>& contacts, const std::vector<OldContact>& old,
                                double reach) {
  // Eq. (10.1); what goes in and out, and in which units, is in convergence.hpp.
  not_implemented("10.1 match_contacts", contacts, old, reach);
}

}  // namespace spook
