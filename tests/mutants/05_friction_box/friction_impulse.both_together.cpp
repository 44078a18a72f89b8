// Wrong: solves the two rows as one system.
// Killed by: FrictionImpulse.TakesEachRowForItself
// Says: This solves both rows together
#include <algorithm>

#include "05_friction_box/friction_box.hpp"

namespace spook {

Vec3 friction_impulse(const Mat3& K, const Vec3& u, const Tangents& tangents, double Gamma, double bound) {
  Eigen::Matrix<double, 3, 2> T;
  T << tangents.t1, tangents.t2;
  const Eigen::Matrix2d S = T.transpose() * K * T + Gamma * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d lambda = -S.inverse() * (T.transpose() * u);
  return std::clamp(lambda[0], -bound, bound) * tangents.t1 +
         std::clamp(lambda[1], -bound, bound) * tangents.t2;
}

}  // namespace spook
