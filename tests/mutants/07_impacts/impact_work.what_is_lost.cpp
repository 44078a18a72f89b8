// Wrong: counts what is lost as positive.
// Killed by: ImpactWork.ByHand
// Says: it is what J adds to the energy
#include "07_impacts/impacts.hpp"

namespace spook {

double impact_work(const Mat3& K, const Vec3& u, const Vec3& J) {
  return -J.dot(u + K * J / 2);
}

}  // namespace spook
