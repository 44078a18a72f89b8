#include "10_convergence/convergence.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

template <int Dof>
std::vector<Twist<Dof>> soft_substep(double h, const SoftParameters& soft, const std::vector<Twist<Dof>>& Wf,
                                     std::vector<Row<Dof>>& rows, std::vector<double>& gaps,
                                     std::vector<Twist<Dof>>& W) {
  // Eq. (10.15), (10.19), (10.21); what goes in and out, and in which units, is in convergence.hpp.
  not_implemented("10.12 soft_substep", h, soft, Wf, rows, gaps, W);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these lines as they are.
template std::vector<Twist<3>> soft_substep<3>(double, const SoftParameters&, const std::vector<Twist<3>>&,
                                               std::vector<Row<3>>&, std::vector<double>&,
                                               std::vector<Twist<3>>&);
template std::vector<Twist<6>> soft_substep<6>(double, const SoftParameters&, const std::vector<Twist<6>>&,
                                               std::vector<Row<6>>&, std::vector<double>&,
                                               std::vector<Twist<6>>&);

}  // namespace spook
