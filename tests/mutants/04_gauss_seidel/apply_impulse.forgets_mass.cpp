// Wrong: scatters with G instead of M⁻¹Gᵀ.
// Killed by: ApplyImpulse.MovesBothBodies
// Says: use MinvGi and MinvGj
#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

template <int Dof>
void apply_impulse(const Row<Dof>& row, double delta, std::vector<Twist<Dof>>& V) {
  V[row.i] += delta * row.Gi;  // Eq. (4.5)
  V[row.j] += delta * row.Gj;
}

template void apply_impulse<3>(const Row<3>&, double, std::vector<Twist<3>>&);
template void apply_impulse<6>(const Row<6>&, double, std::vector<Twist<6>>&);

}  // namespace spook
