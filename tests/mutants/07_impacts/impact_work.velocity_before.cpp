// Wrong: takes the velocity of before for the average.
// Killed by: ImpactWork.ByHand
// Says: This is J·u
#include "07_impacts/impacts.hpp"

namespace spook {

double impact_work(const Mat3&, const Vec3& u, const Vec3& J) {
  return J.dot(u);
}

}  // namespace spook
