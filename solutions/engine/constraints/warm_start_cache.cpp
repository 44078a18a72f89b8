#include "engine/constraints/warm_start_cache.hpp"

#include <algorithm>
#include <numeric>
#include <ranges>
#include <span>
#include <utility>

#include "engine/support/parallel_for.hpp"

namespace spook {

static std::pair<int, int> numbers_of(const auto& contact) {
  return {contact.i, contact.j};
}

/// Returns the end of the contacts of one pair that start at k.
template <class One>
static std::size_t end_of_pair(const std::vector<One>& all, std::size_t k) {
  const auto pair = numbers_of(all[k]);
  while (k < all.size() && numbers_of(all[k]) == pair) ++k;
  return k;
}

static bool contains(const std::vector<std::size_t>& all, std::size_t one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

/// Finds the nearest old contact of each contact of a pair; clears `nearest` if two contacts have the same one. The
/// result is that of match_contacts, in which a contact gets another than its nearest only if another contact has that
/// one.
static void find_nearest(std::span<const Contact> contacts, std::span<const OldContact> old,
                         std::vector<std::size_t>& nearest) {
  nearest.clear();
  nearest.reserve(contacts.size());
  for (const Contact& contact : contacts) {
    double least = infinity;
    std::size_t own = 0;
    for (std::size_t k = 0; k < old.size(); ++k) {
      const double apart = (contact.r_j - old[k].point).squaredNorm();
      if (apart < least) least = apart, own = k;
    }
    if (!(least < infinity) || contains(nearest, own)) return nearest.clear();
    nearest.push_back(own);
  }
}

/// Indices of contacts that are not matched yet: of those of this step, and of old ones.
struct Unmatched {
  std::vector<std::size_t> now, old;
};

/// A range of contacts, whose first and last pairs are complete, and the range of old ones that may be theirs.
struct MatchRange {
  std::size_t begin, end, old_begin, old_end;
};

/// Calls match(old, now) for each contact of the range that has a nearest old contact of its pair in the range.
template <class Match>
static Unmatched match_pairs(const MatchRange& range, const std::vector<Contact>& contacts,
                             const std::vector<OldContact>& old, const Match& match) {
  Unmatched left;
  std::vector<std::size_t> nearest;
  std::size_t k = range.old_begin;
  for (std::size_t c = range.begin, end; c < range.end; c = end) {
    end = end_of_pair(contacts, c);
    while (k < range.old_end && numbers_of(old[k]) < numbers_of(contacts[c])) left.old.push_back(k++);
    const bool there = k < range.old_end && numbers_of(old[k]) == numbers_of(contacts[c]);
    const std::size_t begin = k, old_end = there ? std::min(end_of_pair(old, k), range.old_end) : k;
    find_nearest(std::span(contacts).subspan(c, end - c), std::span(old).subspan(k, old_end - k), nearest);
    for (std::size_t n = 0; n < nearest.size(); ++n) match(begin + nearest[n], c + n);
    if (nearest.empty())
      for (std::size_t n = c; n < end; ++n) left.now.push_back(n);
    for (; k < old_end; ++k)
      if (!contains(nearest, k - begin)) left.old.push_back(k);
  }
  for (; k < range.old_end; ++k) left.old.push_back(k);
  return left;
}

/// Divides contacts, and the old ones, between pairs. Pairs of most contacts are sorted.
static std::vector<MatchRange> match_ranges(const std::vector<Contact>& contacts,
                                            const std::vector<OldContact>& old, std::size_t count) {
  const auto before = [](const OldContact& one, const std::pair<int, int>& pair) {
    return numbers_of(one) < pair;
  };
  std::vector<MatchRange> ranges;
  std::size_t begin = 0, old_begin = 0;
  for (std::size_t n = 1; n <= count; ++n) {
    std::size_t end = std::max(begin, contacts.size() * n / count), old_end = old.size();
    if (n < count) {
      while (end > begin && numbers_of(contacts[end - 1]) == numbers_of(contacts[end])) --end;
      const auto found = std::lower_bound(old.begin(), old.end(), numbers_of(contacts[end]), before);
      old_end = std::max(old_begin, static_cast<std::size_t>(found - old.begin()));
    }
    ranges.push_back({begin, end, old_begin, old_end});
    begin = end;
    old_begin = old_end;
  }
  return ranges;
}

/// Calls match(old, now) for each contact that existed before. Contacts of a pair are consecutive, and pairs are
/// sorted, so most matches are found at once. match_contacts matches the rest.
template <class Match>
static void match_all(const std::vector<Contact>& contacts, const std::vector<OldContact>& old, int threads,
                      const Match& match) {
  const std::size_t shares = shares_of(threads, contacts.size());
  const std::vector<MatchRange> ranges = match_ranges(contacts, old, shares);
  std::vector<Unmatched> of_share(shares);
  parallel_for(threads, contacts.size(), [&](std::size_t share, std::size_t, std::size_t) {
    of_share[share] = match_pairs(ranges[share], contacts, old, match);
  });
  std::vector<Contact> their_contacts;
  std::vector<OldContact> their_old;
  std::vector<std::size_t> now_left, old_left;
  for (const Unmatched& left : of_share) {
    now_left.insert(now_left.end(), left.now.begin(), left.now.end());
    old_left.insert(old_left.end(), left.old.begin(), left.old.end());
  }
  if (now_left.empty()) return;
  for (const std::size_t n : now_left) their_contacts.push_back(contacts[n]);
  for (const std::size_t n : old_left) their_old.push_back(old[n]);
  const std::vector<int> found = match_contacts(their_contacts, their_old, infinity);
  for (std::size_t n = 0; n < now_left.size(); ++n)
    if (found[n] >= 0) match(old_left[static_cast<std::size_t>(found[n])], now_left[n]);
}

/// Returns the friction directions on body j, of a contact whose rows start at `rows`.
template <int Dof>
static Tangents tangents_of(const Row<Dof>* rows) {
  return {rows[1].Gj.template head<3>(), rows[2].Gj.template head<3>()};
}

/// Converts impulses along old tangents to impulses along new ones.
static void turn(const Tangents& old, const Tangents& now, double* along) {
  if (old.t1 == now.t1 && old.t2 == now.t2) return;
  const Vec3 friction = along[0] * old.t1 + along[1] * old.t2;
  along[0] = friction.dot(now.t1);
  along[1] = friction.dot(now.t2);
}

template <int Dof>
void WarmStartCache::remember(const ConstraintSet<Dof>& constraints, const std::vector<Contact>& contacts,
                              double h, int threads) {
  const std::vector<Row<Dof>>& rows = constraints.rows;
  const std::size_t joints = constraints.joint_rows(), first = constraints.first_contact_row;
  joints_.resize(joints);
  resistance_.resize(first - joints);
  contact_rows_.resize(rows.size() - first);
  contacts_.resize(contacts.size());
  parallel_for(threads, rows.size(), [&](std::size_t, std::size_t k, std::size_t end) {
    for (; k < end; ++k)
      (k < joints  ? joints_[k]
       : k < first ? resistance_[k - joints]
                   : contact_rows_[k - first]) = rows[k].lambda;
  });
  tangents_.resize(constraints.rows_per_contact == 3 ? contacts.size() : 0);
  parallel_for(threads, contacts.size(), [&](std::size_t, std::size_t c, std::size_t end) {
    for (; c < end; ++c) {
      contacts_[c] = {contacts[c].i, contacts[c].j, contacts[c].r_j};
      if (!tangents_.empty()) tangents_[c] = tangents_of(&rows[constraints.normal_row(c)]);
    }
  });
  h_ = h;
  sort_pairs();
}

/// Contacts with planes, and those of points, may come before others of a smaller pair.
void WarmStartCache::sort_pairs() {
  by_pair_.clear();
  const auto less = [](const OldContact& one, const OldContact& other) {
    return numbers_of(one) < numbers_of(other);
  };
  if (std::is_sorted(contacts_.begin(), contacts_.end(), less)) return;
  by_pair_.resize(contacts_.size());
  std::iota(by_pair_.begin(), by_pair_.end(), std::size_t{0});
  std::sort(by_pair_.begin(), by_pair_.end(),
            [&](std::size_t one, std::size_t other) { return less(contacts_[one], contacts_[other]); });
}

template <int Dof>
std::vector<double> WarmStartCache::impulses(const ConstraintSet<Dof>& constraints,
                                             const std::vector<Contact>& contacts, double h,
                                             int threads) const {
  if (is_empty()) return {};
  std::vector<double> all = joint_impulses(constraints.joint_rows(), h);
  all.resize(constraints.rows.size(), 0);
  if (constraints.resistance_rows == resistance_.size())
    for (std::size_t k = 0; k < resistance_.size(); ++k)
      all[constraints.joint_rows() + k] = h / h_ * resistance_[k];
  const std::size_t each =
      constraints.rows_per_contact;  // another number if the first friction of a world is new
  if (contacts.empty() || contacts_.empty() || contact_rows_.size() != each * contacts_.size()) return all;
  const double longer = h / h_;
  const auto copy = [&](std::size_t from, std::size_t to) {
    const std::size_t normal = constraints.normal_row(to);
    double* of = &all[normal];
    for (std::size_t n = 0; n < each; ++n) of[n] = longer * contact_rows_[from * each + n];
    if (!tangents_.empty()) turn(tangents_[from], tangents_of(&constraints.rows[normal]), of + 1);
  };
  match_all(contacts, contacts_, threads, copy);
  return all;
}

std::vector<double> WarmStartCache::joint_impulses(std::size_t rows, double h) const {
  if (is_empty()) return {};
  std::vector<double> all(rows, 0);
  for (std::size_t k = 0; k < std::min(rows, joints_.size()); ++k) all[k] = h / h_ * joints_[k];
  return all;
}

double WarmStartCache::contact_force(int i, int j) const {
  if (contacts_.empty()) return 0;
  const std::pair pair(i, j);
  const auto at = [&](std::size_t n) { return by_pair_.empty() ? n : by_pair_[n]; };
  const auto places = std::views::iota(std::size_t{0}, contacts_.size());
  const auto first =
      std::ranges::lower_bound(places, pair, {}, [&](std::size_t n) { return numbers_of(contacts_[at(n)]); });
  double largest = 0;
  const std::size_t each = contact_rows_.size() / contacts_.size();
  for (auto n = static_cast<std::size_t>(first - places.begin());
       n < contacts_.size() && numbers_of(contacts_[at(n)]) == pair; ++n)
    largest = std::max(largest, contact_rows_[at(n) * each] / h_);
  return largest;
}

template std::vector<double> WarmStartCache::impulses<3>(const ConstraintSet<3>&, const std::vector<Contact>&,
                                                         double, int) const;
template std::vector<double> WarmStartCache::impulses<6>(const ConstraintSet<6>&, const std::vector<Contact>&,
                                                         double, int) const;
template void WarmStartCache::remember<3>(const ConstraintSet<3>&, const std::vector<Contact>&, double, int);
template void WarmStartCache::remember<6>(const ConstraintSet<6>&, const std::vector<Contact>&, double, int);

}  // namespace spook
