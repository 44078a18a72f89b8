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
      make_pattern();
    }
    for (int k = 0; k < S_.cols(); ++k)
      for (SparseMatrix::InnerIterator entry(S_, k); entry; ++entry)
        entry.valueRef() = schur_entry(rows[k], rows[entry.row()]) + (entry.row() == k ? rows[k].Sigma : 0);
    return S_;
  }

 private:
  using Ends = std::pair<int, int>;  // of a row: bodies i and j, or -1 for one that its impulse does not move

  /// Sets an entry for each two rows that share a dynamic body, and for each row with itself.
  void make_pattern() {
    int bodies = 0;
    for (const auto& [i, j] : ends_) bodies = std::max({bodies, i + 1, j + 1});
    std::vector<std::vector<int>> rows_of(bodies);
    std::vector<Eigen::Triplet<double>> entries;
    for (int k = 0; k < std::ssize(ends_); ++k) {
      entries.emplace_back(k, k, 0.0);
      for (const int body : {ends_[k].first, ends_[k].second}) {
        if (body < 0) continue;
        for (const int earlier : rows_of[body]) entries.emplace_back(k, earlier, 0.0);
        rows_of[body].push_back(k);
      }
    }
    S_.resize(std::ssize(ends_), std::ssize(ends_));
    S_.setFromTriplets(entries.begin(), entries.end());  // once for each two rows
  }

  std::vector<Ends> ends_;
  SparseMatrix S_;
};

}  // namespace spook
