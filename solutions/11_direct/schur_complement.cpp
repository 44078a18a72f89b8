#include <algorithm>
#include <utility>

#include "11_direct/direct.hpp"

namespace spook {

namespace {

/// The rows that act on each body, from the first to the last.
class RowsOfBodies {
 public:
  template <int Dof>
  explicit RowsOfBodies(const std::vector<Row<Dof>>& rows) : rows_(2 * rows.size()) {
    int bodies = 0;
    for (const Row<Dof>& row : rows) bodies = std::max({bodies, row.i + 1, row.j + 1});
    first_.assign(bodies + 1, 0);
    for (const Row<Dof>& row : rows) ++first_[row.i + 1], ++first_[row.j + 1];
    for (int body = 0; body < bodies; ++body) first_[body + 1] += first_[body];

    std::vector<int> next(first_.begin(), first_.end() - 1);
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (const int body : {rows[k].i, rows[k].j}) rows_[next[body]++] = static_cast<int>(k);
  }

  /// Calls `visit` with every row of a body from row k on.
  template <class Visit>
  void from(int k, int body, const Visit& visit) const {
    const auto end = rows_.begin() + first_[body + 1];
    for (auto l = std::lower_bound(rows_.begin() + first_[body], end, k); l != end; ++l) visit(*l);
  }

 private:
  std::vector<int> first_, rows_;
};

}  // namespace

template <int Dof>
SparseMatrix schur_complement(const std::vector<Row<Dof>>& rows) {
  const int n = static_cast<int>(rows.size());
  const RowsOfBodies touching(rows);
  std::vector<int> outer{0}, inner;  // Eigen's compressed storage
  std::vector<double> values;
  outer.reserve(n + 1), inner.reserve(4 * n), values.reserve(4 * n);

  std::vector<std::pair<int, double>> column;  // a line and its share, from one body
  for (int k = 0; k < n; ++k) {
    column.assign(1, {k, rows[k].Sigma});
    const auto add = [&](int body, const Twist<Dof>& MinvG) {
      if (MinvG.isZero(0)) return;
      touching.from(k, body, [&](int l) {
        column.emplace_back(l, MinvG.dot(rows[l].i == body ? rows[l].Gi : rows[l].Gj));
      });
    };
    add(rows[k].i, rows[k].MinvGi);
    add(rows[k].j, rows[k].MinvGj);

    std::sort(column.begin(), column.end());
    for (const auto& [line, share] : column) {
      if (std::ssize(inner) > outer.back() && inner.back() == line) {
        values.back() += share;
      } else {
        inner.push_back(line);
        values.push_back(share);
      }
    }
    outer.push_back(static_cast<int>(inner.size()));
  }
  return Eigen::Map<const SparseMatrix>(n, n, outer.back(), outer.data(), inner.data(), values.data());
}

template SparseMatrix schur_complement<3>(const std::vector<Row<3>>&);
template SparseMatrix schur_complement<6>(const std::vector<Row<6>>&);

}  // namespace spook
