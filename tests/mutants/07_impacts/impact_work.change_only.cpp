// Wrong: leaves the velocity of before out.
// Killed by: ImpactWork.ByHand
// Says: This is ½ J·KJ
#include "07_impacts/impacts.hpp"

namespace spook {

double impact_work(const Mat3& K, const Vec3&, const Vec3& J) {
  return J.dot(K * J) / 2;
}

}  // namespace spook
