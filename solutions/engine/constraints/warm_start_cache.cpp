#include "engine/constraints/warm_start_cache.hpp"

#include <algorithm>
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

/// Calls match(old, now) for each contact that existed before. Contacts of a pair are consecutive, and pairs are
/// sorted, so most matches are found at once. match_contacts matches the rest.
template <class Match>
static void match_all(const std::vector<Contact>& contacts, const std::vector<OldContact>& old,
                      const Match& match) {
  std::vector<std::size_t> nearest, left, old_left;
  std::size_t k = 0;
  for (std::size_t c = 0, end; c < contacts.size(); c = end) {
    end = end_of_pair(contacts, c);
    while (k < old.size() && numbers_of(old[k]) < numbers_of(contacts[c])) old_left.push_back(k++);
    const bool there = k < old.size() && numbers_of(old[k]) == numbers_of(contacts[c]);
    const std::size_t begin = k, old_end = there ? end_of_pair(old, k) : k;
    find_nearest(std::span(contacts).subspan(c, end - c), std::span(old).subspan(k, old_end - k), nearest);
    for (std::size_t n = 0; n < nearest.size(); ++n) match(begin + nearest[n], c + n);
    if (nearest.empty())
      for (std::size_t n = c; n < end; ++n) left.push_back(n);
    for (; k < old_end; ++k)
      if (!contains(nearest, k - begin)) old_left.push_back(k);
  }
  if (left.empty()) return;
  for (; k < old.size(); ++k) old_left.push_back(k);

  std::vector<Contact> their_contacts;
  std::vector<OldContact> their_old;
  for (const std::size_t n : left) their_contacts.push_back(contacts[n]);
  for (const std::size_t n : old_left) their_old.push_back(old[n]);
  const std::vector<int> found = match_contacts(their_contacts, their_old, infinity);
  for (std::size_t n = 0; n < left.size(); ++n)
    if (found[n] >= 0) match(old_left[static_cast<std::size_t>(found[n])], left[n]);
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
  const std::size_t first = constraints.first_contact_row;
  joints_.resize(first);
  contact_rows_.resize(rows.size() - first);
  contacts_.resize(contacts.size());
  parallel_for(threads, rows.size(), [&](std::size_t, std::size_t k, std::size_t end) {
    for (; k < end; ++k) (k < first ? joints_[k] : contact_rows_[k - first]) = rows[k].lambda;
  });
  for (std::size_t c = 0; c < contacts.size(); ++c)
    contacts_[c] = {contacts[c].i, contacts[c].j, contacts[c].r_j};
  tangents_.resize(constraints.rows_per_contact == 3 ? contacts.size() : 0);
  for (std::size_t c = 0; c < tangents_.size(); ++c)
    tangents_[c] = tangents_of(&rows[constraints.normal_row(c)]);
  h_ = h;
}

template <int Dof>
std::vector<double> WarmStartCache::impulses(const ConstraintSet<Dof>& constraints,
                                             const std::vector<Contact>& contacts, double h) const {
  if (joints_.empty() && contact_rows_.empty()) return {};
  std::vector<double> all = joint_impulses(constraints.first_contact_row, h);
  all.resize(constraints.rows.size(), 0);
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
  match_all(contacts, contacts_, copy);
  return all;
}

std::vector<double> WarmStartCache::joint_impulses(std::size_t rows, double h) const {
  if (joints_.empty() && contact_rows_.empty()) return {};
  std::vector<double> all(rows, 0);
  for (std::size_t k = 0; k < std::min(rows, joints_.size()); ++k) all[k] = h / h_ * joints_[k];
  return all;
}

double WarmStartCache::contact_force(int i, int j) const {
  if (contacts_.empty()) return 0;
  const std::pair pair(i, j);
  const auto before = [](const OldContact& contact, const auto& numbers) {
    return numbers_of(contact) < numbers;
  };
  const auto first = std::lower_bound(contacts_.begin(), contacts_.end(), pair, before);
  double largest = 0;
  const std::size_t each = contact_rows_.size() / contacts_.size();
  for (auto c = static_cast<std::size_t>(first - contacts_.begin());
       c < contacts_.size() && numbers_of(contacts_[c]) == pair; ++c)
    largest = std::max(largest, contact_rows_[c * each] / h_);
  return largest;
}

template std::vector<double> WarmStartCache::impulses<3>(const ConstraintSet<3>&, const std::vector<Contact>&,
                                                         double) const;
template std::vector<double> WarmStartCache::impulses<6>(const ConstraintSet<6>&, const std::vector<Contact>&,
                                                         double) const;
template void WarmStartCache::remember<3>(const ConstraintSet<3>&, const std::vector<Contact>&, double, int);
template void WarmStartCache::remember<6>(const ConstraintSet<6>&, const std::vector<Contact>&, double, int);

}  // namespace spook
