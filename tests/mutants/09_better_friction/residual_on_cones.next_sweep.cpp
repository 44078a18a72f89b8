// Wrong: returns what the next sweep would.
// Killed by: ResidualOnCones.IsWhatEachUpdateByItselfWouldChange
// Says: This is the value that the next sweep returns
#include "09_better_friction/better_friction.hpp"

namespace spook {

template <int Dof>
double residual_on_cones(const std::vector<FrictionContact>& contacts, const std::vector<Row<Dof>>& rows,
                         const std::vector<Twist<Dof>>& V) {
  std::vector<Row<Dof>> next = rows;
  std::vector<Twist<Dof>> after = V;
  return sweep_on_cones(contacts, next, after);
}

template double residual_on_cones<3>(const std::vector<FrictionContact>&, const std::vector<Row<3>>&,
                                     const std::vector<Twist<3>>&);
template double residual_on_cones<6>(const std::vector<FrictionContact>&, const std::vector<Row<6>>&,
                                     const std::vector<Twist<6>>&);

}  // namespace spook
