// Wrong: lets several contacts continue the same old one.
// Killed by: MatchContacts.GivesEachOldOneToTheNearest
// Says: Each old one is used once
#include "10_convergence/convergence.hpp"

namespace spook {

std::vector<int> match_contacts(const std::vector<Contact>& contacts, const std::vector<OldContact>& old,
                                double reach) {
  std::vector<int> match(contacts.size(), -1);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    double nearest = infinity;
    for (std::size_t k = 0; k < old.size(); ++k) {
      if (contacts[c].i != old[k].i || contacts[c].j != old[k].j) continue;
      const double distance = (contacts[c].r_j - old[k].point).norm();
      if (distance > reach || distance >= nearest) continue;
      nearest = distance;
      match[c] = static_cast<int>(k);
    }
  }
  return match;
}

}  // namespace spook
