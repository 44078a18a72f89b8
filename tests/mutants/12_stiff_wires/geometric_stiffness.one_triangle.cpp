// Wrong: fills the lower triangle only.
// Killed by: GeometricStiffness.IsTheSameAllAround
// Says: has a symmetric stiffness
#include "12_stiff_wires/stiff_wires.hpp"

namespace spook {

Mat3 geometric_stiffness(const Vec3& n, double length, double tension) {
  if (tension <= 0) return Mat3::Zero();
  const Mat3 K = tension / length * (Mat3::Identity() - n * n.transpose());
  return K.triangularView<Eigen::Lower>();
}

}  // namespace spook
