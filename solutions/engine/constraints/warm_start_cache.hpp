#pragma once
// Warm start: a row starts with its impulse of the last step, if its joint or contact existed then.
//
//   joints     by index
//   rolling    rows that resist rolling and torsion: by index, if there are as many as in the last step
//   contacts   by match_contacts, Eq. (10.1): the nearest contact of the same pair, at any distance. match_contacts
//              itself runs only for new pairs, and where two contacts have the same nearest one
//   friction   the same vector along the new tangents, which may differ a lot: near an axis, a rounding error of the
//              normal can select other tangents
//   λ ∝ h      forces are kept when the step changes
#include <vector>

#include "05_friction_box/friction_box.hpp"
#include "10_convergence/convergence.hpp"
#include "engine/constraints/constraint_set.hpp"
#include "engine/support/state_stream.hpp"

namespace spook {

inline void state_of(StateStream& s, OldContact& contact) {
  s(contact.i, contact.j, contact.point);
}
inline void state_of(StateStream& s, Tangents& tangents) {
  s(tangents.t1, tangents.t2);
}

class WarmStartCache {
 public:
  /// Removes all impulses.
  void forget() {
    joints_.clear();
    resistance_.clear();
    contact_rows_.clear();
    contacts_.clear();
    tangents_.clear();
    by_pair_.clear();
    h_ = 0;
  }

  /// Stores the impulses of a finished step.
  template <int Dof>
  void remember(const ConstraintSet<Dof>& constraints, const std::vector<Contact>& contacts, double h,
                int threads = 1);

  /// Returns an initial impulse for each row of the next step; 0 for new joints and contacts. Empty if nothing is
  /// stored.
  template <int Dof>
  std::vector<double> impulses(const ConstraintSet<Dof>& constraints, const std::vector<Contact>& contacts,
                               double h, int threads = 1) const;

  /// Returns the initial impulses of the joints' rows, which come first in each step.
  std::vector<double> joint_impulses(std::size_t rows, double h) const;

  /// Returns the largest normal force that one contact of bodies i and j had in the finished step [N]; 0 without one.
  double contact_force(int i, int j) const;

  void state(StateStream& s) {
    s(joints_, resistance_, contact_rows_, contacts_, tangents_, h_);
    sort_pairs();
  }

 private:
  void sort_pairs();
  bool is_empty() const { return joints_.empty() && resistance_.empty() && contact_rows_.empty(); }

  std::vector<double> joints_;        // of each row [N s]
  std::vector<double> resistance_;    // of each row that resists rolling or torsion [N s]
  std::vector<double> contact_rows_;  // of each row [N s]
  std::vector<OldContact> contacts_;
  std::vector<Tangents> tangents_;    // of each contact with friction
  std::vector<std::size_t> by_pair_;  // the contacts in the order of their pairs; empty: they are in this order
  double h_ = 0;
};

}  // namespace spook
