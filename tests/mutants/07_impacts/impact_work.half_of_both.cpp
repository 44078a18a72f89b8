// Wrong: halves the sum.
// Killed by: ImpactWork.ByHand
// Says: u counts in full
#include "07_impacts/impacts.hpp"

namespace spook {

double impact_work(const Mat3& K, const Vec3& u, const Vec3& J) {
  return J.dot(u + K * J / 2) / 2;
}

}  // namespace spook
