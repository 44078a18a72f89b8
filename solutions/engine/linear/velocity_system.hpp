#pragma once
// The matrix M + Gᵀ K G: one block per body, and one for each pair of bodies that share a row.
#include <Eigen/LU>
#include <algorithm>
#include <utility>
#include <vector>

#include "11_direct/direct.hpp"
#include "engine/linear/body_numbers.hpp"

namespace spook {

template <int Dof>
using Block = Eigen::Matrix<double, Dof, Dof>;

inline Block<3> mass_of(const InverseMass<3>& inverse) {
  return Mat3::Identity() / inverse.linear;
}

inline Block<6> mass_of(const InverseMass<6>& inverse) {
  Block<6> M = Block<6>::Zero();
  M.topLeftCorner<3, 3>() = Mat3::Identity() / inverse.linear;
  M.bottomRightCorner<3, 3>() = inverse.angular.inverse();
  return M;
}

/// Rows assembled over dynamic bodies, which are numbered in the order of the rows.
template <int Dof>
class VelocitySystem {
 public:
  VelocitySystem() = default;
  VelocitySystem(const std::vector<Row<Dof>>& rows, const std::vector<InverseMass<Dof>>& inverse_mass) {
    begin(rows, inverse_mass);
  }

  /// Sets new rows. Keeps the pattern if they act on the same bodies as the last ones.
  void begin(const std::vector<Row<Dof>>& rows, const std::vector<InverseMass<Dof>>& inverse_mass) {
    if (!are_alike(rows, inverse_mass)) look_at(rows, inverse_mass);
    for (std::size_t b = 0; b < mass_.size(); ++b) mass_[b] = mass_of(inverse_mass[bodies()[b]]);
  }
  const std::vector<int>& bodies() const { return number_.bodies(); }
  Eigen::Index size() const { return Dof * std::ssize(bodies()); }

  /// Returns M + Gᵀ K G, with the `stiffness` K of each row [kg]; rows of stiffness 0 are skipped.
  const SparseMatrix& matrix(const std::vector<Row<Dof>>& rows, const Vector& stiffness) {
    std::fill(A_.valuePtr(), A_.valuePtr() + A_.nonZeros(), 0.0);
    for (std::size_t b = 0; b < mass_.size(); ++b) add_lower(static_cast<int>(b), mass_[b]);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (stiffness[k] == 0) continue;
      const Row<Dof>& row = rows[k];
      const int i = number_[row.i], j = number_[row.j];
      const Twist<Dof> KGi = stiffness[k] * row.Gi, KGj = stiffness[k] * row.Gj;
      if (i >= 0) add_lower(i, row.Gi * KGi.transpose());
      if (j >= 0) add_lower(j, row.Gj * KGj.transpose());
      if (i >= 0 && j >= 0) add_block(k, i < j ? row.Gj * KGi.transpose() : row.Gi * KGj.transpose());
    }
    return A_;
  }

  /// Adds Gᵀ `impulse` of a row to `right`.
  void scatter(const Row<Dof>& row, double impulse, Vector& right) const {
    const auto add = [&](int body, const Twist<Dof>& G) {
      if (number_[body] >= 0) right.segment<Dof>(Dof * number_[body]) += impulse * G;
    };
    add(row.i, row.Gi);
    add(row.j, row.Gj);
  }

  /// Returns G v of a row.
  double gather(const Row<Dof>& row, const Vector& v) const {
    const auto of = [&](int body, const Twist<Dof>& G) {
      return number_[body] < 0 ? 0.0 : G.dot(v.segment<Dof>(Dof * number_[body]));
    };
    return of(row.i, row.Gi) + of(row.j, row.Gj);
  }

 private:
  bool are_alike(const std::vector<Row<Dof>>& rows, const std::vector<InverseMass<Dof>>& inverse_mass) const {
    const auto alike = [&](const Row<Dof>& row, const std::pair<int, int>& ends) {
      const auto moves = [&](int body) { return is_dynamic(inverse_mass[body]) == (number_[body] >= 0); };
      return std::pair(row.i, row.j) == ends && moves(row.i) && moves(row.j);
    };
    return number_.size() == inverse_mass.size() &&
           std::equal(rows.begin(), rows.end(), ends_.begin(), ends_.end(), alike);
  }

  void look_at(const std::vector<Row<Dof>>& rows, const std::vector<InverseMass<Dof>>& inverse_mass) {
    number_.begin(rows, inverse_mass);
    ends_.clear();
    pairs_.clear();
    for (const Row<Dof>& row : rows) ends_.emplace_back(row.i, row.j);
    mass_.resize(bodies().size());
    for (const Row<Dof>& row : rows) pairs_.push_back(pair_of(row));
    // Blocks below the diagonal, by column, each once.
    std::vector<std::pair<int, int>> blocks;
    for (const auto& [low, high] : pairs_)
      if (low >= 0) blocks.emplace_back(low, high);
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    make_pattern(blocks);
  }

  std::pair<int, int> pair_of(const Row<Dof>& row) const {
    const int i = number_[row.i], j = number_[row.j];
    return std::minmax(i, j);
  }

  void make_pattern(const std::vector<std::pair<int, int>>& blocks) {
    const int n = static_cast<int>(bodies().size());
    std::vector<int> first(n + 1, 0);
    for (const auto& block : blocks) ++first[block.first + 1];
    for (int b = 0; b < n; ++b) first[b + 1] += first[b];
    std::vector<int> outer{0}, inner;
    for (int b = 0; b < n; ++b)
      for (int column = 0; column < Dof; ++column) {
        for (int line = column; line < Dof; ++line) inner.push_back(Dof * b + line);
        for (int at = first[b]; at < first[b + 1]; ++at)
          for (int line = 0; line < Dof; ++line) inner.push_back(Dof * blocks[at].second + line);
        outer.push_back(static_cast<int>(inner.size()));
      }
    const std::vector<double> zeros(inner.size(), 0.0);
    A_ = Eigen::Map<const SparseMatrix>(size(), size(), outer.back(), outer.data(), inner.data(), zeros.data());
    below_.clear();
    for (const auto& pair : pairs_) {
      const auto at = std::lower_bound(blocks.begin(), blocks.end(), pair);
      below_.push_back(pair.first < 0 ? -1 : static_cast<int>(at - blocks.begin()) - first[pair.first]);
    }
  }

  void add_lower(int b, const Block<Dof>& block) {
    for (int column = 0; column < Dof; ++column) {
      double* value = A_.valuePtr() + A_.outerIndexPtr()[Dof * b + column];
      for (int line = column; line < Dof; ++line) *value++ += block(line, column);
    }
  }

  void add_block(std::size_t k, const Block<Dof>& block) {
    for (int column = 0; column < Dof; ++column) {
      double* value =
          A_.valuePtr() + A_.outerIndexPtr()[Dof * pairs_[k].first + column] + (Dof - column) + Dof * below_[k];
      for (int line = 0; line < Dof; ++line) *value++ += block(line, column);
    }
  }

  std::vector<std::pair<int, int>> ends_;  // of each row: bodies i and j
  BodyNumbers number_;                     // of the dynamic bodies that have rows
  std::vector<Block<Dof>> mass_;
  std::vector<std::pair<int, int>> pairs_;  // of each row, the lower number first
  std::vector<int> below_;                  // block of each row in its column
  SparseMatrix A_;
};

}  // namespace spook
