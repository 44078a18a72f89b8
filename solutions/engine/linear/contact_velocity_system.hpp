#pragma once
// The system (M + Gᵀ K G) v = Gᵀ k, in which K couples the rows of a contact and is not symmetric.
#include "engine/linear/block_lu.hpp"
#include "engine/linear/velocity_system.hpp"

namespace spook {

template <int Dof>
class ContactVelocitySystem {
 public:
  /// Numbers the dynamic bodies that have rows, in the order of the rows. Keeps the order of elimination if rows act on
  /// the same bodies as before.
  void begin(const std::vector<Row<Dof>>& rows, const std::vector<InverseMass<Dof>>& inverse_mass) {
    number_.begin(rows, inverse_mass);
    mass_.clear();
    for (const int body : number_.bodies()) mass_.push_back(mass_of(inverse_mass[body]));
    std::vector<std::pair<int, int>> pairs;
    for (const Row<Dof>& row : rows) {
      const std::pair pair(number_[row.i], number_[row.j]);
      const bool both = pair.first >= 0 && pair.second >= 0;
      if (both && (pairs.empty() || pairs.back() != pair)) pairs.push_back(pair);
    }
    if (pairs != pairs_ || v_.size() != mass_.size())
      factors_ = BlockLu<Dof>(static_cast<int>(mass_.size()), pairs);
    pairs_ = std::move(pairs);
    v_.resize(mass_.size());
  }

  /// Sets the matrix to M.
  void begin_matrix() {
    factors_.set_zero();
    for (int b = 0; b < std::ssize(mass_); ++b) factors_.add(b, mass_[b]);
  }

  /// Adds Gᵀ K G of `count` rows between the same two bodies to the matrix.
  void add(const Row<Dof>* rows, int count, const Mat3& K) {
    if (K.isZero(0)) return;
    using Blocks = Eigen::Matrix<double, Dof, 3>;
    Blocks Gi = Blocks::Zero(), Gj = Blocks::Zero();  // transposed
    for (int n = 0; n < count; ++n) {
      Gi.col(n) = rows[n].Gi;
      Gj.col(n) = rows[n].Gj;
    }
    const int i = number_[rows->i], j = number_[rows->j];
    const Blocks GiK = Gi.lazyProduct(K), GjK = Gj.lazyProduct(K);
    if (i >= 0) factors_.add(i, GiK.lazyProduct(Gi.transpose()));
    if (j >= 0) factors_.add(j, GjK.lazyProduct(Gj.transpose()));
    if (i >= 0 && j >= 0) factors_.add(i, j, GiK.lazyProduct(Gj.transpose()), GjK.lazyProduct(Gi.transpose()));
  }

  void factorise() { factors_.factorise(); }

  /// Sets the right-hand side to 0.
  void begin_right() { std::fill(v_.begin(), v_.end(), Twist<Dof>::Zero()); }

  /// Adds Gᵀ k of `count` rows between the same two bodies to the right-hand side.
  void add_right(const Row<Dof>* rows, int count, const Vec3& k) {
    const int i = number_[rows->i], j = number_[rows->j];
    for (int n = 0; n < count; ++n) {
      if (i >= 0) v_[i] += k[n] * rows[n].Gi;
      if (j >= 0) v_[j] += k[n] * rows[n].Gj;
    }
  }

  /// Solves for the velocities; returns false if they are not finite.
  bool solve() {
    factors_.solve(v_);
    return std::all_of(v_.begin(), v_.end(), [](const Twist<Dof>& v) { return v.allFinite(); });
  }

  /// Returns G v of a row.
  double gather(const Row<Dof>& row) const {
    const auto of = [&](int body, const Twist<Dof>& G) {
      return number_[body] < 0 ? 0.0 : G.dot(v_[number_[body]]);
    };
    return of(row.i, row.Gi) + of(row.j, row.Gj);
  }

 private:
  BodyNumbers number_;  // of the dynamic bodies that have rows
  std::vector<Block<Dof>> mass_;
  std::vector<std::pair<int, int>> pairs_;
  std::vector<Twist<Dof>> v_;  // the right-hand side before solve()
  BlockLu<Dof> factors_;
};

}  // namespace spook
