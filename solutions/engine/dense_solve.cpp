#include "engine/dense_solve.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/require.hpp"
#include "engine/islands.hpp"

namespace spook {

namespace {

using Few = std::array<double, most_dense_rows>;

/// S_kl without Σ: the velocity along one row that an impulse of 1 along another makes, Eq. (11.1).
template <int Dof>
double coupling(const Row<Dof>& k, const Row<Dof>& l) {
  double sum = 0;
  if (k.i == l.i) sum += k.MinvGi.dot(l.Gi);
  if (k.i == l.j) sum += k.MinvGi.dot(l.Gj);
  if (k.j == l.i) sum += k.MinvGj.dot(l.Gi);
  if (k.j == l.j) sum += k.MinvGj.dot(l.Gj);
  return sum;
}

/// S = L D Lᵀ, of each line from its first entry on: L has none before that.
class SmallFactors {
 public:
  template <int Dof>
  explicit SmallFactors(const std::vector<Row<Dof>>& rows) : n_(static_cast<int>(rows.size())) {
    for (int k = 0; k < n_ && sound_; ++k) {
      first_[k] = k;
      for (int l = k - 1; l >= 0; --l) {
        L_[k][l] = coupling(rows[k], rows[l]);
        if (L_[k][l] != 0) first_[k] = l;
      }
      factorise_line(k, coupling(rows[k], rows[k]) + rows[k].Sigma);
    }
  }

  bool sound() const { return sound_; }

  Few solve(Few x) const {
    for (int k = 0; k < n_; ++k)
      for (int l = first_[k]; l < k; ++l) x[k] -= L_[k][l] * x[l];
    for (int k = 0; k < n_; ++k) x[k] /= D_[k];
    for (int k = n_ - 1; k >= 0; --k)
      for (int l = first_[k]; l < k; ++l) x[l] -= L_[k][l] * x[k];
    return x;
  }

 private:
  /// On entry the line has the entries of S, but for S_kk.
  void factorise_line(int k, double S_kk) {
    double lost = 0;  // of S_kk: Σ L_kl² D_l
    for (int l = first_[k]; l < k; ++l)
      for (int m = std::max(first_[k], first_[l]); m < l; ++m) L_[k][l] -= L_[k][m] * L_[l][m];
    for (int l = first_[k]; l < k; ++l) {
      const double LD = L_[k][l];
      L_[k][l] /= D_[l];
      lost += L_[k][l] * LD;
    }
    D_[k] = S_kk - lost;
    sound_ = std::isfinite(D_[k]) && D_[k] > 1e-14 * (S_kk + lost);  // Eq. (11.4)
  }

  int n_;
  bool sound_ = true;
  std::array<Few, most_dense_rows> L_;
  Few D_;
  std::array<int, most_dense_rows> first_;
};

/// What each row lacks, Eq. (4.6).
template <int Dof>
Few lacking(const std::vector<Row<Dof>>& rows, const std::vector<Twist<Dof>>& V) {
  Few r;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Row<Dof>& row = rows[k];
    r[k] = row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]) - row.Sigma * row.lambda;
  }
  return r;
}

template <int Dof>
void add(const Few& more, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k].lambda = std::clamp(rows[k].lambda + more[k], rows[k].lo, rows[k].hi);
    apply_impulse(rows[k], more[k], V);
  }
}

/// Eq. (11.13).
template <int Dof>
double roundings(const std::vector<Row<Dof>>& rows) {
  double B = 0, S_lambda = 0;
  for (const Row<Dof>& row : rows) {
    B = std::max(B, std::abs(row.B));
    S_lambda = std::max(S_lambda, row.diagonal * std::abs(row.lambda));
  }
  return 1e-13 * B + 1e-14 * S_lambda;
}

}  // namespace

template <int Dof>
std::optional<SolveReport> dense_solve(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V,
                                       const StopRule& stop) {
  require_positive("max_sweeps", stop.max_sweeps);
  require_not_negative("tolerance", stop.tolerance);
  const std::size_t n = rows.size();
  if (n == 0 || n > most_dense_rows) return {};
  if (n > most_dense_rows_on_bodies && wants_bodies(rows)) return {};
  const SmallFactors factors(rows);
  if (!factors.sound()) return {};

  Few B;
  for (std::size_t k = 0; k < n; ++k) B[k] = rows[k].B;
  const Few lambda = factors.solve(B);
  for (std::size_t k = 0; k < n; ++k)
    if (!(rows[k].lo < lambda[k] && lambda[k] < rows[k].hi)) return {};

  std::fill(V.begin(), V.end(), Twist<Dof>::Zero());
  for (Row<Dof>& row : rows) row.lambda = 0;
  add(lambda, rows, V);
  add(factors.solve(lacking(rows, V)), rows, V);  // V has the roundings of λ/m, and the rows feel them
  const double left = residual(rows, V);
  if (!(left <= std::max(stop.tolerance, roundings(rows)))) return {};
  return SolveReport{.history = {left}, .converged = true};
}

template std::optional<SolveReport> dense_solve<3>(std::vector<Row<3>>&, std::vector<Twist<3>>&,
                                                   const StopRule&);
template std::optional<SolveReport> dense_solve<6>(std::vector<Row<6>>&, std::vector<Twist<6>>&,
                                                   const StopRule&);

}  // namespace spook
