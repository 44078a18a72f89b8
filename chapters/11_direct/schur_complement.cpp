#include "11_direct/direct.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
SparseMatrix schur_complement(const std::vector<Row<Dof>>& rows) {
  // Eq. (11.1); what goes in and out, and in which units, is in direct.hpp.
  not_implemented("11.1 schur_complement", rows);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template SparseMatrix schur_complement<3>(const std::vector<Row<3>>&);
template SparseMatrix schur_complement<6>(const std::vector<Row<6>>&);

}  // namespace spook
