// Wrong: takes the velocity of after for the change of it on average.
// Killed by: ImpactWork.ByHand
// Says: ½ is missing
#include "07_impacts/impacts.hpp"

namespace spook {

double impact_work(const Mat3& K, const Vec3& u, const Vec3& J) {
  return J.dot(u + K * J);
}

}  // namespace spook
