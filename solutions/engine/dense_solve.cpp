#include "engine/dense_solve.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/require.hpp"

namespace spook {

namespace {

using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_dense_rows, most_dense_rows>;
using Few = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_dense_rows, 1>;

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

/// The lower triangle of S.
template <int Dof>
Small dense_complement(const std::vector<Row<Dof>>& rows) {
  const auto n = std::ssize(rows);
  Small S(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    for (Eigen::Index l = 0; l <= k; ++l) S(k, l) = coupling(rows[k], rows[l]);
    S(k, k) += rows[k].Sigma;
  }
  return S;
}

/// Whether every pivot is sound, Eq. (11.4): Σ_j L_kj² is what S_kk lost.
bool sound(const Eigen::LLT<Small>& factors, const Small& S) {
  if (factors.info() != Eigen::Success) return false;
  for (Eigen::Index k = 0; k < S.rows(); ++k) {
    const double L_kk = factors.matrixLLT()(k, k), pivot = L_kk * L_kk;
    if (!(std::isfinite(pivot) && pivot > 1e-14 * (2 * S(k, k) - pivot))) return false;
  }
  return true;
}

/// Eq. (11.13).
double roundings(const Small& S, const Few& B, const Few& lambda) {
  return 1e-13 * B.cwiseAbs().maxCoeff() + 1e-14 * S.diagonal().cwiseProduct(lambda).cwiseAbs().maxCoeff();
}

}  // namespace

template <int Dof>
std::optional<SolveReport> dense_solve(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V,
                                       const StopRule& stop) {
  require_positive("max_sweeps", stop.max_sweeps);
  require_not_negative("tolerance", stop.tolerance);
  const auto n = std::ssize(rows);
  if (n == 0 || n > most_dense_rows) return {};

  const Small S = dense_complement(rows);
  const Eigen::LLT<Small> factors(S);
  if (!sound(factors, S)) return {};

  Few B(n);
  for (Eigen::Index k = 0; k < n; ++k) B[k] = rows[k].B;
  const Few lambda = factors.solve(B);
  for (Eigen::Index k = 0; k < n; ++k)
    if (!(rows[k].lo < lambda[k] && lambda[k] < rows[k].hi)) return {};

  std::fill(V.begin(), V.end(), Twist<Dof>::Zero());
  for (Eigen::Index k = 0; k < n; ++k) {
    rows[k].lambda = lambda[k];
    apply_impulse(rows[k], lambda[k], V);
  }
  Few lacking(n);  // V has the roundings of λ/m, and the rows feel them
  for (Eigen::Index k = 0; k < n; ++k)
    lacking[k] = B[k] - rows[k].Gi.dot(V[rows[k].i]) - rows[k].Gj.dot(V[rows[k].j]) - rows[k].Sigma * lambda[k];
  const Few more = factors.solve(lacking);
  for (Eigen::Index k = 0; k < n; ++k) {
    rows[k].lambda = std::clamp(lambda[k] + more[k], rows[k].lo, rows[k].hi);
    apply_impulse(rows[k], more[k], V);
  }
  const double left = residual(rows, V);
  if (!(left <= std::max(stop.tolerance, roundings(S, B, lambda)))) return {};
  return SolveReport{.history = {left}, .converged = true};
}

template std::optional<SolveReport> dense_solve<3>(std::vector<Row<3>>&, std::vector<Twist<3>>&,
                                                   const StopRule&);
template std::optional<SolveReport> dense_solve<6>(std::vector<Row<6>>&, std::vector<Twist<6>>&,
                                                   const StopRule&);

}  // namespace spook
