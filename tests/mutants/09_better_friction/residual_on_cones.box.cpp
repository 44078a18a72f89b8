// Wrong: is chapter 04's residual.
// Killed by: ResidualOnCones.IsZeroWhereCoulombsLawHolds
// Says: This is Eq. (4.8) for all rows
#include "09_better_friction/better_friction.hpp"

namespace spook {

template <int Dof>
double residual_on_cones(const std::vector<FrictionContact>&, const std::vector<Row<Dof>>& rows,
                         const std::vector<Twist<Dof>>& V) {
  return residual(rows, V);
}

template double residual_on_cones<3>(const std::vector<FrictionContact>&, const std::vector<Row<3>>&,
                                     const std::vector<Twist<3>>&);
template double residual_on_cones<6>(const std::vector<FrictionContact>&, const std::vector<Row<6>>&,
                                     const std::vector<Twist<6>>&);

}  // namespace spook
