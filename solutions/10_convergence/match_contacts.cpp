#include <algorithm>
#include <compare>
#include <numeric>

#include "10_convergence/convergence.hpp"

namespace spook {

namespace {

struct Candidate {
  double distance;
  int contact, old;
  auto operator<=>(const Candidate&) const = default;
};

/// Returns the numbers 0 to n - 1, sorted by their pairs; numbers of equal pairs keep their order.
template <class PairOf>
std::vector<int> sorted(std::size_t n, const PairOf& pair) {
  std::vector<int> numbers(n);
  std::iota(numbers.begin(), numbers.end(), 0);
  const auto before = [&](int a, int b) { return pair(a) < pair(b); };
  if (!std::is_sorted(numbers.begin(), numbers.end(), before))
    std::stable_sort(numbers.begin(), numbers.end(), before);
  return numbers;
}

}  // namespace

std::vector<int> match_contacts(const std::vector<Contact>& contacts, const std::vector<OldContact>& old,
                                double reach) {
  const auto pair = [&](int k) { return std::pair(old[k].i, old[k].j); };
  const auto pair_now = [&](int c) { return std::pair(contacts[c].i, contacts[c].j); };
  const std::vector<int> by_pair = sorted(old.size(), pair), now = sorted(contacts.size(), pair_now);

  std::vector<int> match(contacts.size(), -1);
  std::vector<bool> taken(old.size(), false);
  std::vector<Candidate> candidates;
  auto first_old = by_pair.begin();
  for (std::size_t first = 0, last; first < now.size(); first = last) {
    for (last = first + 1; last < now.size() && pair_now(now[last]) == pair_now(now[first]);) ++last;
    const std::pair wanted = pair_now(now[first]);
    first_old = std::find_if(first_old, by_pair.end(), [&](int k) { return pair(k) >= wanted; });
    candidates.clear();
    for (std::size_t n = first; n < last; ++n) {
      const int c = now[n];
      for (auto k = first_old; k != by_pair.end() && pair(*k) == wanted; ++k) {
        const double distance = (contacts[c].r_j - old[*k].point).norm();
        if (distance <= reach) candidates.push_back({distance, c, *k});
      }
    }
    std::sort(candidates.begin(), candidates.end());
    for (const Candidate& candidate : candidates) {
      if (match[candidate.contact] >= 0 || taken[candidate.old]) continue;
      match[candidate.contact] = candidate.old;
      taken[candidate.old] = true;
    }
  }
  return match;
}

}  // namespace spook
