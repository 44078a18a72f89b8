// Wrong: takes a contact that continues the old one of index 0 for one that is new.
// Killed by: MatchContacts.TakesTheNearestOfTwo
// Says: has the nearer one already
#include <algorithm>

#include "10_convergence/convergence.hpp"

namespace spook {

namespace {

struct Candidate {
  double distance;
  int contact, old;
};

}  // namespace

std::vector<int> match_contacts(const std::vector<Contact>& contacts, const std::vector<OldContact>& old,
                                double reach) {
  // Both lists have the contacts of a pair together, but the pairs in any order: find a pair's old ones by search.
  std::vector<int> by_pair(old.size());
  for (std::size_t k = 0; k < old.size(); ++k) by_pair[k] = static_cast<int>(k);
  const auto pair = [&](int k) { return std::pair(old[k].i, old[k].j); };
  std::stable_sort(by_pair.begin(), by_pair.end(), [&](int a, int b) { return pair(a) < pair(b); });

  std::vector<Candidate> candidates;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const std::pair wanted(contacts[c].i, contacts[c].j);
    auto k = std::lower_bound(by_pair.begin(), by_pair.end(), wanted,
                              [&](int a, const auto& value) { return pair(a) < value; });
    for (; k != by_pair.end() && pair(*k) == wanted; ++k) {
      const double distance = (contacts[c].r_j - old[*k].point).norm();
      if (distance <= reach) candidates.push_back({distance, static_cast<int>(c), *k});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });

  std::vector<int> match(contacts.size(), -1);
  std::vector<bool> taken(old.size(), false);
  for (const Candidate& candidate : candidates) {
    if (match[candidate.contact] > 0 || taken[candidate.old]) continue;
    match[candidate.contact] = candidate.old;
    taken[candidate.old] = true;
  }
  return match;
}

}  // namespace spook
