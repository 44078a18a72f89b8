// Wrong: takes the largest |r|.
// Killed by: ResidualOnCones.IsZeroWhereCoulombsLawHolds
// Says: This is the largest |r|
#include <algorithm>
#include <cmath>

#include "09_better_friction/better_friction.hpp"

namespace spook {

template <int Dof>
double residual_on_cones(const std::vector<FrictionContact>&, const std::vector<Row<Dof>>& rows,
                         const std::vector<Twist<Dof>>& V) {
  double largest = 0;
  for (const Row<Dof>& row : rows) {
    const double r = row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]) - row.Sigma * row.lambda;
    largest = std::max(largest, std::abs(r));
  }
  return largest;
}

template double residual_on_cones<3>(const std::vector<FrictionContact>&, const std::vector<Row<3>>&,
                                     const std::vector<Twist<3>>&);
template double residual_on_cones<6>(const std::vector<FrictionContact>&, const std::vector<Row<6>>&,
                                     const std::vector<Twist<6>>&);

}  // namespace spook
