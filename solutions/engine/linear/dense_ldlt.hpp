#pragma once
// Dense factors A = L D Lᵀ, Eq. (11.3), of a small matrix on the stack. Each row of L starts at its first nonzero
// entry, so a chain causes no fill-in.
#include <algorithm>
#include <array>
#include <cmath>

namespace spook {

/// Factors of a small positive definite matrix.
class DenseLdlt {
 public:
  static constexpr int most = 32;  ///< largest number of rows

  /// Sets the matrix to n rows of zeros, n <= most.
  void begin(int n) {
    n_ = n;
    for (int k = 0; k < n_; ++k) std::fill_n(L_[k].begin(), k + 1, 0.0);
  }

  /// The entry (k, l) of the matrix, l <= k.
  double& at(int k, int l) { return L_[k][l]; }

  /// Factorises the matrix. Returns false, with useless factors, if a pivot fails Eq. (11.4): too small, not positive
  /// or not finite.
  bool factorise() {
    for (int k = 0; k < n_; ++k) {
      first_[k] = static_cast<int>(std::find_if(L_[k].begin(), L_[k].begin() + k, is_entry) - L_[k].begin());
      if (!factorise_line(k)) return false;
    }
    return true;
  }

  /// Replaces x by A⁻¹ x. x has one entry per row.
  void solve(double* x) const {
    for (int k = 0; k < n_; ++k)
      for (int l = first_[k]; l < k; ++l) x[k] -= L_[k][l] * x[l];
    for (int k = 0; k < n_; ++k) x[k] /= D_[k];
    for (int k = n_ - 1; k >= 0; --k)
      for (int l = first_[k]; l < k; ++l) x[l] -= L_[k][l] * x[k];
  }

 private:
  static bool is_entry(double value) { return value != 0; }

  bool factorise_line(int k) {
    double lost = 0;  // subtracted from A_kk: Σ L_kl² D_l
    for (int l = first_[k]; l < k; ++l)
      for (int m = std::max(first_[k], first_[l]); m < l; ++m) L_[k][l] -= L_[k][m] * L_[l][m];
    for (int l = first_[k]; l < k; ++l) {
      const double LD = L_[k][l];
      L_[k][l] /= D_[l];
      lost += L_[k][l] * LD;
    }
    D_[k] = L_[k][k] - lost;
    return std::isfinite(D_[k]) && D_[k] > 1e-14 * (L_[k][k] + lost);  // Eq. (11.4)
  }

  int n_ = 0;
  std::array<std::array<double, most>, most> L_;  // A before factorise()
  std::array<double, most> D_;
  std::array<int, most> first_;
};

}  // namespace spook
