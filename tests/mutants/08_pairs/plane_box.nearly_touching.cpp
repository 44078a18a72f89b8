// Wrong: counts corners that are a micrometre in front of the plane.
// Killed by: PlaneBox.TouchesFromZeroGapOn
// Says: Only g <= 0 is a contact
#include "08_pairs/pairs.hpp"

namespace spook {

void plane_box(const Plane& plane, const Box& box, std::vector<Contact>& contacts) {
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0})
      for (const double c : {-1.0, 1.0}) {
        const Vec3 r = box.axes * Vec3(a, b, c).cwiseProduct(box.half_sides);
        const Vec3 p = box.x + r;
        const double gap = plane.n.dot(p) - plane.offset;  // Eq. (8.4)
        if (!(gap <= 1e-6)) continue;
        contacts.push_back({.i = plane.body,
                            .j = box.body,
                            .n = plane.n,
                            .gap = gap,
                            .r_i = p - plane.x,  // Eq. (8.3)
                            .r_j = r});
      }
}

}  // namespace spook
