// Wrong: takes the absolute value.
// Killed by: ImpactWork.ByHand
// Says: No absolute value
#include <cmath>

#include "07_impacts/impacts.hpp"

namespace spook {

double impact_work(const Mat3& K, const Vec3& u, const Vec3& J) {
  return std::abs(J.dot(u + K * J / 2));  // Eq. (7.6)
}

}  // namespace spook
