#include <algorithm>
#include <cmath>
#include <numeric>

#include "10_convergence/convergence.hpp"
#include "common/require.hpp"

namespace spook {

namespace {

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Returns S x for impulses x [m/s]; and the velocities that x causes, in U.
template <int Dof>
std::vector<double> S_times(const std::vector<double>& x, const std::vector<Row<Dof>>& rows,
                            std::vector<Twist<Dof>>& U) {
  std::fill(U.begin(), U.end(), Twist<Dof>::Zero());
  for (std::size_t k = 0; k < rows.size(); ++k) apply_impulse(rows[k], x[k], U);
  std::vector<double> Sx(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k)
    Sx[k] = rows[k].Gi.dot(U[rows[k].i]) + rows[k].Gj.dot(U[rows[k].j]) + rows[k].Sigma * x[k];
  return Sx;
}

/// The residuals of the rows.
struct Look {
  std::vector<double> r;     ///< Eq. (4.6) [m/s]
  std::vector<bool> free;    ///< lo < λ < hi
  double residual = 0;       ///< Eq. (4.8)
  bool left_behind = false;  ///< a row at a bound has a larger residual than every free row
};

template <int Dof>
Look look_at(const std::vector<Row<Dof>>& rows, const std::vector<Twist<Dof>>& V) {
  Look seen{.r = std::vector<double>(rows.size()), .free = std::vector<bool>(rows.size())};
  double of_free = 0, of_others = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Row<Dof>& row = rows[k];
    const double r = row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]) - row.Sigma * row.lambda;
    const double next = std::clamp(row.lambda + r / row.diagonal, row.lo, row.hi);
    const double lacks = row.diagonal * std::abs(next - row.lambda);
    if (std::isnan(lacks) || lacks > seen.residual) seen.residual = lacks;
    seen.free[k] = row.lambda > row.lo && row.lambda < row.hi;
    seen.r[k] = r;
    double& largest = seen.free[k] ? of_free : of_others;
    largest = std::max(largest, lacks);
  }
  seen.left_behind = of_others > of_free;
  return seen;
}

/// Moves along p as far as the energy falls, Eq. (10.8). Returns whether no bound limited the step.
template <int Dof>
bool step(const std::vector<double>& p, const std::vector<double>& r, std::vector<Row<Dof>>& rows,
          std::vector<Twist<Dof>>& V) {
  std::vector<Twist<Dof>> U(V.size());
  const double alpha = dot(p, r) / dot(p, S_times(p, rows, U));
  if (!(alpha > 0)) return false;

  std::vector<double> d(rows.size());
  bool whole = true;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double next = rows[k].lambda + alpha * p[k];
    whole = whole && next >= rows[k].lo && next <= rows[k].hi;
    d[k] = std::clamp(next, rows[k].lo, rows[k].hi) - rows[k].lambda;
  }
  double t = alpha;
  if (!whole) {
    const double dSd = dot(d, S_times(d, rows, U));
    if (!(dSd > 0)) return false;
    t = std::clamp(dot(d, r) / dSd, 0.0, 1.0);
  }
  const std::vector<double>& along = whole ? p : d;
  for (std::size_t k = 0; k < rows.size(); ++k)
    rows[k].lambda = std::clamp(rows[k].lambda + t * along[k], rows[k].lo, rows[k].hi);
  for (std::size_t body = 0; body < V.size(); ++body) V[body] += t * U[body];
  return whole;
}

}  // namespace

template <int Dof>
SolveReport conjugate_solve(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V, const StopRule& stop) {
  require_positive("max_sweeps", stop.max_sweeps);
  require_not_negative("tolerance", stop.tolerance);

  SolveReport report;
  report.converged = rows.empty();
  std::vector<double> p(rows.size(), 0);
  double zr = 0;
  bool whole = false;  // the last step was not limited by a bound, so its direction can be used again
  while (!report.converged && std::ssize(report.history) < stop.max_sweeps) {
    Look seen = look_at(rows, V);
    const bool sweeps = !whole || seen.left_behind;
    report.history.push_back(sweeps ? sweep(rows, V) : seen.residual);
    report.converged = report.history.back() <= stop.tolerance;
    if (report.converged) break;

    if (sweeps) seen = look_at(rows, V);
    const std::vector<double> z = precondition(rows, seen.r, seen.free, V.size());
    const double zr_before = std::exchange(zr, dot(z, seen.r));
    const double beta = sweeps ? 0 : zr / zr_before;
    for (std::size_t k = 0; k < rows.size(); ++k) p[k] = z[k] + beta * p[k];  // Eq. (10.7)
    whole = step(p, seen.r, rows, V);
  }
  return report;
}

template SolveReport conjugate_solve<3>(std::vector<Row<3>>&, std::vector<Twist<3>>&, const StopRule&);
template SolveReport conjugate_solve<6>(std::vector<Row<6>>&, std::vector<Twist<6>>&, const StopRule&);

}  // namespace spook
