// Wrong: takes the first old contact within reach.
// Killed by: MatchContacts.FollowsPointsThatMoved
// Says: Of those within reach, 0.3 m, the nearest is the one
#include "10_convergence/convergence.hpp"

namespace spook {

std::vector<int> match_contacts(const std::vector<Contact>& contacts, const std::vector<OldContact>& old,
                                double reach) {
  std::vector<int> match(contacts.size(), -1);
  std::vector<bool> taken(old.size(), false);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    for (std::size_t k = 0; k < old.size(); ++k) {
      if (taken[k] || contacts[c].i != old[k].i || contacts[c].j != old[k].j) continue;
      const double distance = (contacts[c].r_j - old[k].point).norm();
      if (distance > reach || match[c] >= 0) continue;
      match[c] = static_cast<int>(k);
    }
    if (match[c] >= 0) taken[match[c]] = true;
  }
  return match;
}

}  // namespace spook
