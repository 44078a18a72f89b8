#include "engine/solvers/small_direct.hpp"

#include <array>

#include "common/require.hpp"
#include "engine/linear/schur_entry.hpp"
#include "engine/solvers/factor_cost.hpp"
#include "engine/solvers/solve_inside.hpp"

namespace spook {

namespace {

using Few = std::array<double, most_dense_rows>;  // one number per row

/// Factorises S of all rows, Eq. (11.1); returns false if a pivot fails Eq. (11.4).
template <int Dof>
bool factorise(const std::vector<Row<Dof>>& rows, DenseLdlt& factors) {
  const int n = static_cast<int>(rows.size());
  factors.begin(n);
  for (int k = 0; k < n; ++k) {
    for (int l = 0; l < k; ++l) factors.at(k, l) = schur_entry(rows[k], rows[l]);
    factors.at(k, k) = schur_entry(rows[k], rows[k]) + rows[k].Sigma;
  }
  return factors.factorise();
}

}  // namespace

template <int Dof>
std::optional<SolveReport> small_direct(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V,
                                        const StopRule& stop, const std::vector<FrictionContact>& friction) {
  require_positive("max_sweeps", stop.max_sweeps);
  require_not_negative("tolerance", stop.tolerance);
  const std::size_t n = rows.size();
  if (n == 0 || n > most_dense_rows) return {};
  if (n > most_dense_rows_on_bodies && wants_bodies(rows)) return {};
  DenseLdlt factors;
  if (!factorise(rows, factors)) return {};

  Few x;
  return solve_inside(rows, V, stop, friction, x, [&](Few& values) { factors.solve(values.data()); });
}

template std::optional<SolveReport> small_direct<3>(std::vector<Row<3>>&, std::vector<Twist<3>>&,
                                                    const StopRule&, const std::vector<FrictionContact>&);
template std::optional<SolveReport> small_direct<6>(std::vector<Row<6>>&, std::vector<Twist<6>>&,
                                                    const StopRule&, const std::vector<FrictionContact>&);

}  // namespace spook
