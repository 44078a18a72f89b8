#pragma once
// M + Gᵀ K G where K couples the rows of a contact, and is not symmetric: a block for each two bodies, both ways.
#include <Eigen/SparseLU>
#include <algorithm>
#include <vector>

#include "engine/on_bodies.hpp"

namespace spook {

template <int Dof>
class CoupledBodies {
 public:
  using Impulses = Eigen::Matrix<double, Dof, 1>;

  /// The bodies that move and have rows, numbered as rows come to them.
  CoupledBodies(const std::vector<Row<Dof>>& rows, const std::vector<InverseMass<Dof>>& inverse_mass)
      : number_(inverse_mass.size(), -1) {
    for (const Row<Dof>& row : rows)
      for (const int body : {row.i, row.j})
        if (inverse_mass[body].linear > 0 && number_[body] < 0) {
          number_[body] = static_cast<int>(mass_.size());
          mass_.push_back(mass_of(inverse_mass[body]));
          neighbours_.push_back({number_[body]});
        }
    for (const Row<Dof>& row : rows) {
      const int i = number_[row.i], j = number_[row.j];
      if (i < 0 || j < 0 || (!neighbours_[i].empty() && neighbours_[i].back() == j)) continue;
      neighbours_[i].push_back(j);
      neighbours_[j].push_back(i);
    }
    for (std::vector<int>& all : neighbours_) {
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
    }
    make_pattern();
    factors_.isSymmetric(true);  // its pattern
    factors_.analyzePattern(A_);
  }

  /// M, and a right side of 0.
  void begin() {
    std::fill(A_.valuePtr(), A_.valuePtr() + A_.nonZeros(), 0.0);
    right_ = Vector::Zero(A_.rows());
    for (int b = 0; b < std::ssize(mass_); ++b) add_block(b, b, mass_[b]);
  }

  /// Gᵀ K G and Gᵀ `impulses` of `count` rows between the same two bodies.
  void add(const Row<Dof>* rows, int count, const Mat3& K, const Vec3& impulses) {
    Eigen::Matrix<double, Dof, 3> Gi = Eigen::Matrix<double, Dof, 3>::Zero(), Gj = Gi;
    for (int n = 0; n < count; ++n) {
      Gi.col(n) = rows[n].Gi;
      Gj.col(n) = rows[n].Gj;
    }
    const int i = number_[rows->i], j = number_[rows->j];
    const Eigen::Matrix<double, Dof, 3> GiK = Gi * K, GjK = Gj * K;
    if (i >= 0) add_block(i, i, GiK * Gi.transpose());
    if (j >= 0) add_block(j, j, GjK * Gj.transpose());
    if (i >= 0 && j >= 0) {
      add_block(i, j, GiK * Gj.transpose());
      add_block(j, i, GjK * Gi.transpose());
    }
    if (i >= 0) right_.template segment<Dof>(Dof * i) += Gi * impulses;
    if (j >= 0) right_.template segment<Dof>(Dof * j) += Gj * impulses;
  }

  /// The velocities that solve it; false where a pivot is 0, or something is not finite.
  bool solve() {
    factors_.factorize(A_);
    if (factors_.info() != Eigen::Success) return false;
    v_ = factors_.solve(right_);
    return v_.allFinite();
  }

  /// G v of a row.
  double gather(const Row<Dof>& row) const {
    const auto of = [&](int body, const Twist<Dof>& G) {
      return number_[body] < 0 ? 0.0 : G.dot(v_.template segment<Dof>(Dof * number_[body]));
    };
    return of(row.i, row.Gi) + of(row.j, row.Gj);
  }

 private:
  void make_pattern() {
    std::vector<int> outer{0}, inner;
    for (const std::vector<int>& all : neighbours_)
      for (int column = 0; column < Dof; ++column) {
        for (const int b : all)
          for (int line = 0; line < Dof; ++line) inner.push_back(Dof * b + line);
        outer.push_back(static_cast<int>(inner.size()));
      }
    const std::vector<double> zeros(inner.size(), 0.0);
    const Eigen::Index size = Dof * std::ssize(mass_);
    A_ = Eigen::Map<const SparseMatrix>(size, size, outer.back(), outer.data(), inner.data(), zeros.data());
  }

  void add_block(int lines, int columns, const Block<Dof>& block) {
    const std::vector<int>& all = neighbours_[columns];
    const auto place = Dof * (std::lower_bound(all.begin(), all.end(), lines) - all.begin());
    for (int column = 0; column < Dof; ++column) {
      double* values = A_.valuePtr() + A_.outerIndexPtr()[Dof * columns + column] + place;
      for (int line = 0; line < Dof; ++line) values[line] += block(line, column);
    }
  }

  std::vector<int> number_;  // of each body among those that move and have rows; -1 for others
  std::vector<Block<Dof>> mass_;
  std::vector<std::vector<int>> neighbours_;  // of each, itself included, in order
  SparseMatrix A_;
  Vector right_, v_;
  Eigen::SparseLU<SparseMatrix, Eigen::AMDOrdering<int>> factors_;
};

}  // namespace spook
