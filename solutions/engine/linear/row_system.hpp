#pragma once
// The Schur complement S of rows, Eq. (11.1), whose pattern is kept while the rows act on the same bodies.
#include <algorithm>
#include <utility>
#include <vector>

#include "11_direct/direct.hpp"
#include "engine/linear/body_numbers.hpp"
#include "engine/linear/schur_entry.hpp"

namespace spook {

class RowSystem {
 public:
  /// Returns S of the rows, its lower triangle. Valid until the next call.
  template <int Dof>
  const SparseMatrix& matrix(const std::vector<Row<Dof>>& rows) {
    const auto acts_on = [](const Row<Dof>& row) -> Ends {
      return {moves_i(row) ? row.i : -1, moves_j(row) ? row.j : -1};
    };
    const auto alike = [&](const Row<Dof>& row, const Ends& ends) { return acts_on(row) == ends; };
    if (!std::equal(rows.begin(), rows.end(), ends_.begin(), ends_.end(), alike)) {
      ends_.clear();
      for (const Row<Dof>& row : rows) ends_.push_back(acts_on(row));
      S_ = schur_complement(rows);
    }
    // Always: a sum in another order would have other last bits where the pattern is not kept.
    for (int k = 0; k < S_.cols(); ++k)
      for (SparseMatrix::InnerIterator entry(S_, k); entry; ++entry)
        entry.valueRef() = schur_entry(rows[k], rows[entry.row()]) + (entry.row() == k ? rows[k].Sigma : 0);
    return S_;
  }

 private:
  using Ends = std::pair<int, int>;  // of a row: bodies i and j, or -1 for one that its impulse does not move

  std::vector<Ends> ends_;
  SparseMatrix S_;
};

}  // namespace spook
