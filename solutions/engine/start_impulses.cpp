#include "engine/start_impulses.hpp"

#include <algorithm>

#include "engine/shares.hpp"

namespace spook {

/// Whether match_contacts finds each in its own place: as many of the same pairs, which follow each other, and each of a pair
/// is nearest to its own, and its own to it, of all that are left by those before it.
static bool are_in_place(const std::vector<Contact>& contacts, const std::vector<OldContact>& old) {
  const auto same_pair = [](const auto& one, const auto& other) {
    return one.i == other.i && one.j == other.j;
  };
  if (!std::equal(contacts.begin(), contacts.end(), old.begin(), old.end(), same_pair)) return false;
  const auto apart = [&](std::size_t c, std::size_t k) {
    return (contacts[c].r_j - old[k].point).squaredNorm();
  };
  for (std::size_t c = 0; c < contacts.size(); ++c)
    for (std::size_t k = c + 1; k < contacts.size() && same_pair(contacts[c], contacts[k]); ++k)
      if (std::min(apart(c, k), apart(k, c)) <= apart(c, c)) return false;
  return true;
}

template <int Dof>
void StartImpulses::remember(const std::vector<Row<Dof>>& rows, std::size_t first,
                             const std::vector<Contact>& contacts, double h, int threads) {
  joints_.resize(first);
  contact_rows_.resize(rows.size() - first);
  contacts_.resize(contacts.size());
  in_shares(threads, rows.size(), [&](std::size_t, std::size_t k, std::size_t end) {
    for (; k < end; ++k) (k < first ? joints_[k] : contact_rows_[k - first]) = rows[k].lambda;
  });
  for (std::size_t c = 0; c < contacts.size(); ++c)
    contacts_[c] = {contacts[c].i, contacts[c].j, contacts[c].r_j};
  h_ = h;
}

std::vector<double> StartImpulses::impulses(std::size_t rows, std::size_t first,
                                            const std::vector<Contact>& contacts, double h) const {
  if (joints_.empty() && contact_rows_.empty()) return {};
  std::vector<double> all(rows, 0);
  std::copy_n(joints_.begin(), std::min(first, joints_.size()), all.begin());
  if (!contacts.empty() && !contacts_.empty()) {
    const std::size_t each = contact_rows_.size() / contacts_.size();  // as many as ever, in one world
    const auto copy = [&](std::size_t from, std::size_t to) {
      std::copy_n(contact_rows_.begin() + static_cast<std::ptrdiff_t>(from * each), each,
                  all.begin() + static_cast<std::ptrdiff_t>(first + to * each));
    };
    if (are_in_place(contacts, contacts_)) {
      for (std::size_t c = 0; c < contacts.size(); ++c) copy(c, c);
    } else {
      const std::vector<int> old = match_contacts(contacts, contacts_, infinity);
      for (std::size_t c = 0; c < contacts.size(); ++c)
        if (old[c] >= 0) copy(static_cast<std::size_t>(old[c]), c);
    }
  }
  for (double& impulse : all) impulse *= h / h_;
  return all;
}

template void StartImpulses::remember<3>(const std::vector<Row<3>>&, std::size_t, const std::vector<Contact>&,
                                         double, int);
template void StartImpulses::remember<6>(const std::vector<Row<6>>&, std::size_t, const std::vector<Contact>&,
                                         double, int);

}  // namespace spook
