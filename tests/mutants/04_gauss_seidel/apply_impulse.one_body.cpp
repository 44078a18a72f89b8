// Wrong: moves body j only.
// Killed by: ApplyImpulse.MovesBothBodies
// Says: This body has not moved
#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

template <int Dof>
void apply_impulse(const Row<Dof>& row, double delta, std::vector<Twist<Dof>>& V) {
  V[row.j] += delta * row.MinvGj;
}

template void apply_impulse<3>(const Row<3>&, double, std::vector<Twist<3>>&);
template void apply_impulse<6>(const Row<6>&, double, std::vector<Twist<6>>&);

}  // namespace spook
