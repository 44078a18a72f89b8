#pragma once
// What the rows of a step begin with: the impulses of the last one, where joint or contact were there already.
//
//   joints     by their index
//   contacts   by match_contacts, Eq. (10.1): the nearest of the same pair, however far; what rests has its own in its own
//              place, and is not matched anew
//   λ ∝ h      a force stays a force when the step changes
#include <vector>

#include "10_convergence/convergence.hpp"

namespace spook {

class WarmStartCache {
 public:
  /// Keeps the impulses of a step that is done: `first` rows of joints, then those of the contacts.
  template <int Dof>
  void remember(const std::vector<Row<Dof>>& rows, std::size_t first, const std::vector<Contact>& contacts,
                double h, int threads = 1);

  /// One for each row of the next step; 0 for what is new. Empty when nothing is kept.
  std::vector<double> impulses(std::size_t rows, std::size_t first, const std::vector<Contact>& contacts,
                               double h) const;

 private:
  std::vector<double> joints_;        // of each row [N s]
  std::vector<double> contact_rows_;  // of each row [N s]
  std::vector<OldContact> contacts_;
  double h_ = 0;
};

}  // namespace spook
