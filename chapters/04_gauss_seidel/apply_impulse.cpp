#include "04_gauss_seidel/gauss_seidel.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
void apply_impulse(const Row<Dof>& row, double delta, std::vector<Twist<Dof>>& V) {
  // Eq. (4.5); what goes in and out, and in which units, is in gauss_seidel.hpp.
  not_implemented("4.2 apply_impulse", row, delta, V);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template void apply_impulse<3>(const Row<3>&, double, std::vector<Twist<3>>&);
template void apply_impulse<6>(const Row<6>&, double, std::vector<Twist<6>>&);

}  // namespace spook
