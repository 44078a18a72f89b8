#include "08_pairs/pairs.hpp"

namespace spook {

std::vector<Vec3> clip(const std::vector<Vec3>& polygon, const Vec3& n, double offset) {
  std::vector<Vec3> left;
  left.reserve(polygon.size() + 1);  // of a convex polygon a plane leaves one corner more at most
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double height_a = n.dot(a) - offset, height_b = n.dot(b) - offset;
    if (height_a <= 0) left.push_back(a);
    if ((height_a < 0 && height_b > 0) || (height_a > 0 && height_b < 0))
      left.push_back(a + height_a / (height_a - height_b) * (b - a));  // Eq. (8.8)
  }
  return left;
}

}  // namespace spook
