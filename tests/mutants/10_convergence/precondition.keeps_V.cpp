// Wrong: keeps V from one call to the next.
// Killed by: Precondition.LeavesTheOthersAlone
// Says: Something is kept from call to call
#include "10_convergence/convergence.hpp"

namespace spook {

template <int Dof>
std::vector<double> precondition(const std::vector<Row<Dof>>& rows, const std::vector<double>& r,
                                 const std::vector<bool>& free, std::size_t bodies) {
  std::vector<double> z(rows.size(), 0);
  static std::vector<Twist<Dof>> V;
  V.resize(bodies, Twist<Dof>::Zero());
  const auto update = [&](std::size_t k) {  // Eq. (4.6), (4.7) with r for B, and no bounds
    if (!free[k]) return;
    const Row<Dof>& row = rows[k];
    const double lacks = r[k] - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]) - row.Sigma * z[k];
    z[k] += lacks / row.diagonal;
    apply_impulse(row, lacks / row.diagonal, V);
  };
  for (std::size_t k = 0; k < rows.size(); ++k) update(k);
  for (std::size_t k = rows.size(); k-- > 0;) update(k);
  return z;
}

template std::vector<double> precondition<3>(const std::vector<Row<3>>&, const std::vector<double>&,
                                             const std::vector<bool>&, std::size_t);
template std::vector<double> precondition<6>(const std::vector<Row<6>>&, const std::vector<double>&,
                                             const std::vector<bool>&, std::size_t);

}  // namespace spook
