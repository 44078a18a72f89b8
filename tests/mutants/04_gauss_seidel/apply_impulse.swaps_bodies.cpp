// Wrong: gives each body the other one's block.
// Killed by: ApplyImpulse.ConservesMomentum
// Says: over its own mass
#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

template <int Dof>
void apply_impulse(const Row<Dof>& row, double delta, std::vector<Twist<Dof>>& V) {
  V[row.j] += delta * row.MinvGi;  // Eq. (4.5)
  V[row.i] += delta * row.MinvGj;
}

template void apply_impulse<3>(const Row<3>&, double, std::vector<Twist<3>>&);
template void apply_impulse<6>(const Row<6>&, double, std::vector<Twist<6>>&);

}  // namespace spook
