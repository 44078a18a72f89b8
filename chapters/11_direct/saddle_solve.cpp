#include "11_direct/direct.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
bool saddle_solve(std::vector<Row<Dof>>& rows, const std::vector<InverseMass<Dof>>& inverse_mass,
                  std::vector<Twist<Dof>>& V, Factors& factors) {
  // Eq. (11.2); what goes in and out, and in which units, is in direct.hpp.
  not_implemented("11.4 saddle_solve", rows, inverse_mass, V, factors);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template bool saddle_solve<3>(std::vector<Row<3>>&, const std::vector<InverseMass<3>>&, std::vector<Twist<3>>&,
                              Factors&);
template bool saddle_solve<6>(std::vector<Row<6>>&, const std::vector<InverseMass<6>>&, std::vector<Twist<6>>&,
                              Factors&);

}  // namespace spook
