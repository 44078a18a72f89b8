#include "engine/start_impulses.hpp"

#include <algorithm>

namespace spook {

template <int Dof>
void StartImpulses::remember(const std::vector<Row<Dof>>& rows, std::size_t first,
                             const std::vector<Contact>& contacts, double h) {
  joints_.clear();
  contact_rows_.clear();
  contacts_.clear();
  for (std::size_t k = 0; k < rows.size(); ++k) (k < first ? joints_ : contact_rows_).push_back(rows[k].lambda);
  for (const Contact& contact : contacts) contacts_.push_back({contact.i, contact.j, contact.r_j});
  h_ = h;
}

std::vector<double> StartImpulses::impulses(std::size_t rows, std::size_t first,
                                            const std::vector<Contact>& contacts, double h) const {
  if (joints_.empty() && contact_rows_.empty()) return {};
  std::vector<double> all(rows, 0);
  std::copy_n(joints_.begin(), std::min(first, joints_.size()), all.begin());
  if (!contacts.empty() && !contacts_.empty()) {
    const std::size_t each = contact_rows_.size() / contacts_.size();  // as many as ever, in one world
    const std::vector<int> old = match_contacts(contacts, contacts_, infinity);
    for (std::size_t c = 0; c < contacts.size(); ++c)
      if (old[c] >= 0)
        std::copy_n(
            contact_rows_.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(old[c]) * each), each,
            all.begin() + static_cast<std::ptrdiff_t>(first + c * each));
  }
  for (double& impulse : all) impulse *= h / h_;
  return all;
}

template void StartImpulses::remember<3>(const std::vector<Row<3>>&, std::size_t, const std::vector<Contact>&,
                                         double);
template void StartImpulses::remember<6>(const std::vector<Row<6>>&, std::size_t, const std::vector<Contact>&,
                                         double);

}  // namespace spook
