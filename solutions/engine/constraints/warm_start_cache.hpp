#pragma once
// What the rows of a step begin with: the impulses of the last one, where joint or contact were there already.
//
//   joints     by their index
//   contacts   by match_contacts, Eq. (10.1): the nearest of the same pair, however far; what rests has its own in its own
//              place, and is not matched anew
//   friction   the same vector along the tangents of now, which may have turned: those of a normal that points along an axis
//              may be others after a rounding
//   λ ∝ h      a force stays a force when the step changes
#include <vector>

#include "05_friction_box/friction_box.hpp"
#include "10_convergence/convergence.hpp"

namespace spook {

class WarmStartCache {
 public:
  /// Keeps the impulses of a step that is done: `first` rows of joints, then those of the contacts.
  template <int Dof>
  void remember(const std::vector<Row<Dof>>& rows, std::size_t first, const std::vector<Contact>& contacts,
                double h, int threads = 1);

  /// Returns one for each row of the next step; 0 for what is new. Empty when nothing is kept.
  template <int Dof>
  std::vector<double> impulses(const std::vector<Row<Dof>>& rows, std::size_t first,
                               const std::vector<Contact>& contacts, double h) const;

  /// The same of the rows of joints, the first in each step.
  std::vector<double> joint_impulses(std::size_t rows, double h) const;

 private:
  std::vector<double> joints_;        // of each row [N s]
  std::vector<double> contact_rows_;  // of each row [N s]
  std::vector<OldContact> contacts_;
  std::vector<Tangents> tangents_;  // of each contact with friction
  double h_ = 0;
};

}  // namespace spook
