#pragma once
// Factors P A Pᵀ = L Lᵀ of a sparse positive definite matrix, by dense fronts.
//
//   nodes    successive unknowns with the same later neighbours, as those of a joint or a body
//   fronts   nodes in the order of engine/linear/elimination.hpp, joined where L has nearly the same entries below them
//   panel    the columns of L of a front: its own unknowns, and the later ones that they act on, its border
//   rest     minus the products of the panel's border with itself. The front of the border's first unknown, its parent,
//            adds this to its own entries
//
// Dense arithmetic is several times as fast as sparse arithmetic, which spends most of its time on finding entries.
// J. W. H. Liu, "The multifrontal method for sparse matrix solution: theory and practice", SIAM Review 34 (1992).
#include <utility>
#include <vector>

#include "11_direct/direct.hpp"

namespace spook {

class FrontalCholesky {
 public:
  /// Factorises a matrix of at least one unknown, given as its lower triangle, compressed, with all of its diagonal.
  /// Analyses it only if its pattern differs from the last one. Returns false, with useless factors, if a pivot fails Eq. (11.4): too small, not positive or not finite.
  bool factorise(const SparseMatrix& A);

  /// Returns A⁻¹ b.
  Vector solve(const Vector& b) const;

  /// Returns the number of analyses so far.
  int analyses() const { return analyses_; }

 private:
  struct Front {
    int first = 0, width = 0;                  // own unknowns, by their places
    std::vector<int> border;                   // places, ascending
    std::vector<int> in_parent;                // index of each unknown of the border in the parent
    std::vector<int> children;                 // fronts that are added to this one
    std::vector<std::pair<int, int>> entries;  // of A, and where each is in the panel
    Eigen::MatrixXd panel, rest;               // of rest: its lower triangle

    bool eliminate(const Vector& diagonal);
    void subtract_products(int begin, int end, int at, double* from) const;
    void solve_forward(Vector& x, std::vector<double>& of_border) const;
    void solve_backward(Vector& x, std::vector<double>& of_border) const;
  };

  bool has_pattern_of(const SparseMatrix& A) const;
  void analyse(const SparseMatrix& A);
  void assemble(const SparseMatrix& A, Front& front);

  std::vector<int> columns_, entries_;  // the pattern, as in Eigen's compressed storage
  std::vector<int> place_;              // of each unknown in the order
  Vector diagonal_;                     // of A, by places
  std::vector<Front> fronts_;
  int analyses_ = 0;
};

}  // namespace spook
