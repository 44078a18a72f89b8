// Wrong: leaves out a contact exactly at the reach.
// Killed by: MatchContacts.MarksNewContactsAndDropsLostOnes
// Says: at most `reach`, <= and not <
#include "10_convergence/convergence.hpp"

namespace spook {

std::vector<int> match_contacts(const std::vector<Contact>& contacts, const std::vector<OldContact>& old,
                                double reach) {
  std::vector<int> match(contacts.size(), -1);
  std::vector<bool> taken(old.size(), false);
  for (;;) {
    double nearest = infinity;
    std::size_t contact = 0, found = old.size();
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      if (match[c] >= 0) continue;
      for (std::size_t k = 0; k < old.size(); ++k) {
        if (taken[k]) continue;
        if (contacts[c].i != old[k].i || contacts[c].j != old[k].j) continue;
        const double distance = (contacts[c].r_j - old[k].point).norm();
        if (distance >= reach || distance >= nearest) continue;
        nearest = distance;
        contact = c;
        found = k;
      }
    }
    if (found == old.size()) return match;
    match[contact] = static_cast<int>(found);
    taken[found] = true;
  }
}

}  // namespace spook
