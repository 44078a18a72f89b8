#include "11_direct/direct.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
SparseMatrix saddle_matrix(const std::vector<Row<Dof>>& rows,
                           const std::vector<InverseMass<Dof>>& inverse_mass) {
  // Eq. (11.2); what goes in and out, and in which units, is in direct.hpp.
  not_implemented("11.2 saddle_matrix", rows, inverse_mass);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template SparseMatrix saddle_matrix<3>(const std::vector<Row<3>>&, const std::vector<InverseMass<3>>&);
template SparseMatrix saddle_matrix<6>(const std::vector<Row<6>>&, const std::vector<InverseMass<6>>&);

}  // namespace spook
