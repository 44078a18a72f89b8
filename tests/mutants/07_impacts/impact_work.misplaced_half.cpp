// Wrong: halves the work of the velocity of after.
// Killed by: ImpactWork.ByHand
// Says: ½ is in the wrong place
#include "07_impacts/impacts.hpp"

namespace spook {

double impact_work(const Mat3& K, const Vec3& u, const Vec3& J) {
  return J.dot(u + K * J) / 2;  // Eq. (7.6)
}

}  // namespace spook
