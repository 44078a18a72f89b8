#pragma once
// A few unknowns by dense factors: A = L D Lᵀ, Eq. (11.3), on the stack, each line of L from its first entry on. So a chain
// fills nothing in, and there is no pattern to look up.
#include <algorithm>
#include <array>
#include <cmath>

namespace spook {

/// Factors of a positive definite matrix of a few lines.
class DenseLdlt {
 public:
  static constexpr int most = 32;  ///< lines

  /// n lines of zeros, n <= most.
  void begin(int n) {
    n_ = n;
    for (int k = 0; k < n_; ++k) std::fill_n(L_[k].begin(), k + 1, 0.0);
  }

  /// The entry (k, l), l <= k.
  double& at(int k, int l) { return L_[k][l]; }

  /// False for a pivot that is not sound, Eq. (11.4), not positive or not finite; the factors are then of no use.
  bool factorise() {
    for (int k = 0; k < n_; ++k) {
      first_[k] = static_cast<int>(std::find_if(L_[k].begin(), L_[k].begin() + k, is_entry) - L_[k].begin());
      if (!factorise_line(k)) return false;
    }
    return true;
  }

  /// x becomes A⁻¹ x; it has an entry a line.
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
    double lost = 0;  // of A_kk: Σ L_kl² D_l
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
  std::array<std::array<double, most>, most> L_;  // A at first
  std::array<double, most> D_;
  std::array<int, most> first_;
};

}  // namespace spook
