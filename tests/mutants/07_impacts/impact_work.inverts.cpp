// Wrong: takes K for a mass.
// Killed by: ImpactWork.ByHand
// Says: multiply J by it
#include <Eigen/Cholesky>

#include "07_impacts/impacts.hpp"

namespace spook {

double impact_work(const Mat3& K, const Vec3& u, const Vec3& J) {
  return J.dot(u + K.llt().solve(J) / 2);
}

}  // namespace spook
