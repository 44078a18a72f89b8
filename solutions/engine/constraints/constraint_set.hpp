#pragma once
// The rows of a step, and the places of joints and contacts among them.
#include <optional>
#include <vector>

#include "09_better_friction/better_friction.hpp"

namespace spook {

/// The rows of the joints, then those that resist rolling and torsion, then those of the contacts. All contacts have
/// the same number of rows: the normal row, and the rows of two tangents if any pair has friction.
template <int Dof>
struct ConstraintSet {
  std::vector<Row<Dof>> rows = {};
  std::size_t first_contact_row = 0;
  std::size_t resistance_rows = 0;   ///< the last ones before first_contact_row
  std::size_t rows_per_contact = 1;  ///< 1, or 3 with friction
  /// Contacts whose friction follows the normal impulse, in the order of their rows. Empty for the friction box.
  std::vector<FrictionContact> friction = {};

  /// Returns the number of rows of joints, which come first.
  std::size_t joint_rows() const { return first_contact_row - resistance_rows; }

  /// Returns the index of a contact's normal row.
  std::size_t normal_row(std::size_t contact) const { return first_contact_row + rows_per_contact * contact; }

  /// Returns the contact that has this normal row; none for other rows.
  std::optional<std::size_t> contact_of_normal_row(std::size_t row) const {
    if (row < first_contact_row || (row - first_contact_row) % rows_per_contact != 0) return {};
    return (row - first_contact_row) / rows_per_contact;
  }

  /// Tells whether a row is of friction.
  bool is_friction(std::size_t row) const { return row >= first_contact_row && !contact_of_normal_row(row); }

  void clear() {
    rows.clear();
    friction.clear();
    first_contact_row = resistance_rows = 0;
  }
};

}  // namespace spook
