// Wrong: assumes that both lists are in the same order.
// Killed by: MatchContacts.FindsThemInAnyOrder
// Says: These are the contacts' own indices
#include "10_convergence/convergence.hpp"

namespace spook {

std::vector<int> match_contacts(const std::vector<Contact>& contacts, const std::vector<OldContact>& old,
                                double reach) {
  std::vector<int> match(contacts.size(), -1);
  for (std::size_t c = 0; c < contacts.size() && c < old.size(); ++c)
    if (reach >= 0) match[c] = static_cast<int>(c);
  return match;
}

}  // namespace spook
