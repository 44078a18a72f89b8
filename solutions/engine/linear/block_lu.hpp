#pragma once
// Factors A = L U of a block matrix with a symmetric pattern and unsymmetric values, one block row per body.
//
//   pattern    engine/linear/elimination.hpp
//   values     U_pj = D_p⁻¹ A_pj,  A_ij -= A_ip U_pj for all later neighbours i and j of p; the blocks left below
//              the diagonal are L
//
// U is stored by rows, so that D_p⁻¹ acts on whole rows of a block. Blocks are multiplied in place: for such small ones
// Eigen's general products and solves spend most of their time outside of the arithmetic.
//
// Pivoting is within the diagonal blocks D_p only, not between blocks. The mass of a body usually keeps D_p regular,
// except where the normal force that friction induces outweighs its braking.
#include <Eigen/LU>
#include <algorithm>
#include <utility>
#include <vector>

#include "engine/linear/elimination.hpp"

namespace spook {

template <int Dof>
class BlockLu {
 public:
  using Block = Eigen::Matrix<double, Dof, Dof>;
  using BodyVector = Eigen::Matrix<double, Dof, 1>;

  BlockLu() = default;

  /// Analyses the pattern of `count` bodies, and of the pairs of bodies that share a row.
  BlockLu(int count, const std::vector<std::pair<int, int>>& pairs)
      : first_(count), diagonal_(count), factors_(count) {
    Elimination found = eliminate(count, pairs);
    place_ = std::move(found.place);
    later_ = std::move(found.later);
    int blocks = 0;
    for (int p = 0; p < count; ++p) {
      first_[p] = blocks;
      blocks += static_cast<int>(later_[p].size());
    }
    lower_.resize(blocks);
    upper_.resize(blocks);
  }

  void set_zero() {
    std::fill(diagonal_.begin(), diagonal_.end(), Block::Zero());
    std::fill(lower_.begin(), lower_.end(), Block::Zero());
    std::fill(upper_.begin(), upper_.end(), RowBlock::Zero());
  }

  /// Adds to the block of a body.
  template <class Product>
  void add(int body, const Product& product) {
    diagonal_[place_[body]] += product;
  }

  /// Adds to the two blocks of a pair: in the rows of i and the columns of j, and the other way round.
  template <class Product, class OtherProduct>
  void add(int i, int j, const Product& ij, const OtherProduct& ji) {
    const int b = block_of(std::min(place_[i], place_[j]), std::max(place_[i], place_[j]));
    if (place_[i] < place_[j]) {
      upper_[b] += ij;
      lower_[b] += ji;
    } else {
      lower_[b] += ij;
      upper_[b] += ji;
    }
  }

  void factorise() {
    for (int p = 0; p < std::ssize(later_); ++p) {
      factors_[p].compute(diagonal_[p]);
      const std::vector<int>& all = later_[p];
      const int count = static_cast<int>(all.size());
      const Block* lower = lower_.data() + first_[p];
      RowBlock* upper = upper_.data() + first_[p];
      for (int j = 0; j < count; ++j) divide(factors_[p], upper[j]);
      for (int i = 0; i < count; ++i) {
        diagonal_[all[i]].noalias() -= lower[i].lazyProduct(upper[i]);
        // The later neighbours of p that follow all[i] are later neighbours of all[i], too, in the same order.
        auto neighbour = later_[all[i]].begin();
        for (int j = i + 1; j < count; ++j, ++neighbour) {
          while (*neighbour != all[j]) ++neighbour;
          const auto b = first_[all[i]] + (neighbour - later_[all[i]].begin());
          upper_[b].noalias() -= lower[i].lazyProduct(upper[j]);
          lower_[b].noalias() -= lower[j].lazyProduct(upper[i]);
        }
      }
    }
  }

  /// Solves A x = b in place, with one part of x per body. The result is not finite if a diagonal block is singular.
  void solve(std::vector<BodyVector>& x) const {
    const int count = static_cast<int>(later_.size());
    std::vector<BodyVector> y(x.size());
    for (std::size_t b = 0; b < x.size(); ++b) y[place_[b]] = x[b];
    for (int p = 0; p < count; ++p) {
      y[p] = factors_[p].solve(y[p]).eval();
      for (std::size_t i = 0; i < later_[p].size(); ++i) y[later_[p][i]] -= lower_[first_[p] + i] * y[p];
    }
    for (int p = count - 1; p >= 0; --p)
      for (std::size_t i = 0; i < later_[p].size(); ++i) y[p] -= upper_[first_[p] + i] * y[later_[p][i]];
    for (std::size_t b = 0; b < x.size(); ++b) x[b] = y[place_[b]];
  }

 private:
  using RowBlock = Eigen::Matrix<double, Dof, Dof, Eigen::RowMajor>;

  /// X <- D⁻¹ X, with the factors of D.
  static void divide(const Eigen::PartialPivLU<Block>& D, RowBlock& X) {
    const Block& LU = D.matrixLU();
    X = (D.permutationP() * X).eval();
    for (int k = 0; k < Dof; ++k)
      for (int i = k + 1; i < Dof; ++i) X.row(i) -= LU(i, k) * X.row(k);
    for (int k = Dof - 1; k >= 0; --k) {
      X.row(k) *= 1 / LU(k, k);
      for (int i = 0; i < k; ++i) X.row(i) -= LU(i, k) * X.row(k);
    }
  }

  /// Returns the index of a pair's blocks.
  int block_of(int low, int high) const {
    const auto found = std::lower_bound(later_[low].begin(), later_[low].end(), high);
    return first_[low] + static_cast<int>(found - later_[low].begin());
  }

  std::vector<int> place_;               // of each body in the order of elimination
  std::vector<std::vector<int>> later_;  // later neighbours of each place
  std::vector<int> first_;               // first block of each place
  std::vector<Block> diagonal_, lower_;
  std::vector<RowBlock> upper_;
  std::vector<Eigen::PartialPivLU<Block>> factors_;
};

}  // namespace spook
