#pragma once
// Factors A = L U of a block matrix with a symmetric pattern and unsymmetric values, one block row per body.
//
//   order      of elimination, for little fill: Eigen's AMD                                         as Eq. (11.3)
//   pattern    the later neighbours of a body; eliminating the body makes them neighbours of each other
//   values     U_pj = D_p⁻¹ A_pj,  A_ij -= A_ip U_pj for all later neighbours i and j of p; the blocks left below
//              the diagonal are L
//
// Pivoting is within the diagonal blocks D_p only, not between blocks. The mass of a body usually keeps D_p regular,
// except where the normal force that friction induces outweighs its braking.
#include <Eigen/LU>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <utility>
#include <vector>

namespace spook {

template <int Dof>
class BlockLu {
 public:
  using Block = Eigen::Matrix<double, Dof, Dof>;
  using BodyVector = Eigen::Matrix<double, Dof, 1>;

  BlockLu() = default;

  /// Analyses the pattern of `count` bodies, and of the pairs of bodies that share a row.
  BlockLu(int count, const std::vector<std::pair<int, int>>& pairs)
      : place_(count), later_(count), first_(count), diagonal_(count), factors_(count) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int b = 0; b < count; ++b) entries.emplace_back(b, b, 1);
    for (const auto& [i, j] : pairs) {
      entries.emplace_back(i, j, 1);
      entries.emplace_back(j, i, 1);
    }
    Eigen::SparseMatrix<double> graph(count, count);
    graph.setFromTriplets(entries.begin(), entries.end());
    Eigen::AMDOrdering<int>::PermutationType order;
    Eigen::AMDOrdering<int>()(graph, order);  // order of elimination
    for (int p = 0; p < count; ++p) place_[order.indices()[p]] = p;

    for (const auto& [i, j] : pairs) {
      const auto [low, high] = std::minmax(place_[i], place_[j]);
      later_[low].push_back(high);
    }
    int blocks = 0;
    for (int p = 0; p < count; ++p) {
      std::vector<int>& all = later_[p];
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
      if (!all.empty()) later_[all.front()].insert(later_[all.front()].end(), all.begin() + 1, all.end());
      first_[p] = blocks;
      blocks += static_cast<int>(all.size());
    }
    lower_.resize(blocks);
    upper_.resize(blocks);
  }

  void set_zero() {
    for (std::vector<Block>* all : {&diagonal_, &lower_, &upper_})
      std::fill(all->begin(), all->end(), Block::Zero());
  }

  /// The block in the rows of one body and the columns of another, or of the same body.
  Block& block(int lines, int columns) { return at(place_[lines], place_[columns]); }

  void factorise() {
    for (int p = 0; p < std::ssize(later_); ++p) {
      factors_[p].compute(diagonal_[p]);
      const std::vector<int>& all = later_[p];
      const int first = first_[p], count = static_cast<int>(all.size());
      for (int j = 0; j < count; ++j) {
        upper_[first + j] = factors_[p].solve(upper_[first + j]).eval();
        for (int i = 0; i < count; ++i) at(all[i], all[j]).noalias() -= lower_[first + i] * upper_[first + j];
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
  Block& at(int line, int column) {
    if (line == column) return diagonal_[line];
    const auto [low, high] = std::minmax(line, column);
    const auto found = std::lower_bound(later_[low].begin(), later_[low].end(), high);
    return (line > column ? lower_ : upper_)[first_[low] + (found - later_[low].begin())];
  }

  std::vector<int> place_;               // of each body in the order of elimination
  std::vector<std::vector<int>> later_;  // later neighbours of each place
  std::vector<int> first_;               // first block of each place
  std::vector<Block> diagonal_, lower_, upper_;
  std::vector<Eigen::PartialPivLU<Block>> factors_;
};

}  // namespace spook
