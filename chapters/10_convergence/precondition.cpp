#include "10_convergence/convergence.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
std::vector<double> precondition(const std::vector<Row<Dof>>& rows, const std::vector<double>& r,
                                 const std::vector<bool>& free, std::size_t bodies) {
  // Eq. (10.6); what goes in and out, and in which units, is in convergence.hpp.
  not_implemented("10.7 precondition", rows, r, free, bodies);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template std::vector<double> precondition<3>(const std::vector<Row<3>>&, const std::vector<double>&,
                                             const std::vector<bool>&, std::size_t);
template std::vector<double> precondition<6>(const std::vector<Row<6>>&, const std::vector<double>&,
                                             const std::vector<bool>&, std::size_t);

}  // namespace spook
