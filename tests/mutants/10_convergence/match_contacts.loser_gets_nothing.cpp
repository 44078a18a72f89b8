// Wrong: gives a contact that lost its nearest nothing at all.
// Killed by: MatchContacts.GivesTheNextNearestToAnUnmatchedContact
// Says: but another one is within reach
#include "10_convergence/convergence.hpp"

namespace spook {

std::vector<int> match_contacts(const std::vector<Contact>& contacts, const std::vector<OldContact>& old,
                                double reach) {
  std::vector<int> match(contacts.size(), -1);
  std::vector<bool> taken(old.size(), false);
  std::vector<double> distance_of(old.size(), infinity);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    double nearest = infinity;
    std::size_t found = old.size();
    for (std::size_t k = 0; k < old.size(); ++k) {
      if (contacts[c].i != old[k].i || contacts[c].j != old[k].j) continue;
      const double distance = (contacts[c].r_j - old[k].point).norm();
      if (distance > reach || distance >= nearest) continue;
      nearest = distance;
      found = k;
    }
    if (found == old.size() || nearest >= distance_of[found]) continue;
    for (int& other : match)
      if (taken[found] && other == static_cast<int>(found)) other = -1;
    match[c] = static_cast<int>(found);
    taken[found] = true;
    distance_of[found] = nearest;
  }
  return match;
}

}  // namespace spook
