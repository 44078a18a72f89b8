#include "10_convergence/convergence.hpp"
#include "common/require.hpp"

namespace spook {

template <int Dof>
std::vector<Twist<Dof>> soft_substep(double h, const SoftParameters& soft, const std::vector<Twist<Dof>>& Wf,
                                     std::vector<Row<Dof>>& rows, std::vector<double>& gaps,
                                     std::vector<Twist<Dof>>& W) {
  require_positive("h", h);
  if (gaps.size() != rows.size()) reject("gaps", static_cast<double>(gaps.size()), "one for each row");

  for (std::size_t i = 0; i < W.size(); ++i) W[i] += Wf[i];
  for (const Row<Dof>& row : rows) apply_impulse(row, row.lambda, W);  // warm start

  // Soft sweep, then the motion of the gaps.                               Eq. (10.21), (10.19)
  for (std::size_t k = 0; k < rows.size(); ++k) update_soft_row(h, soft, gaps[k], rows[k], W);
  const std::vector<Twist<Dof>> moving = W;
  for (std::size_t k = 0; k < rows.size(); ++k)
    gaps[k] += h * (rows[k].Gi.dot(W[rows[k].i]) + rows[k].Gj.dot(W[rows[k].j]));

  // Relaxing sweep: the same rows, but rigid.                              Eq. (10.15)
  const SoftParameters rigid;
  for (std::size_t k = 0; k < rows.size(); ++k) update_soft_row(h, rigid, gaps[k], rows[k], W);
  return moving;
}

template std::vector<Twist<3>> soft_substep<3>(double, const SoftParameters&, const std::vector<Twist<3>>&,
                                               std::vector<Row<3>>&, std::vector<double>&,
                                               std::vector<Twist<3>>&);
template std::vector<Twist<6>> soft_substep<6>(double, const SoftParameters&, const std::vector<Twist<6>>&,
                                               std::vector<Row<6>>&, std::vector<double>&,
                                               std::vector<Twist<6>>&);

}  // namespace spook
