#include "12_stiff_wires/stiff_wires.hpp"
#include "common/not_implemented.hpp"

namespace spook {

SparseMatrix stiffened_matrix(const std::vector<Row<3>>& rows, const std::vector<InverseMass<3>>& inverse_mass,
                              const std::vector<Stiffness>& stiffness, double h) {
  // Eq. (12.5); what goes in and out, and in which units, is in stiff_wires.hpp.
  not_implemented("12.3 stiffened_matrix", rows, inverse_mass, stiffness, h);
}

}  // namespace spook
