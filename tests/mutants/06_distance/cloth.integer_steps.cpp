// Wrong: divides a by cells_u as integers.
// Killed by: Cloth.LiesFlat
// Says: a/cells_u of two integers loses the fraction
#include "06_distance/distance.hpp"
#include "common/require.hpp"

namespace spook {

Net cloth(const Vec3& corner, const Vec3& u, const Vec3& v, int cells_u, int cells_v, double mass) {
  require_all_finite("corner", corner);
  require_all_finite("u", u);
  require_all_finite("v", v);
  if (cells_u < 1) reject("cells_u", cells_u, "at least 1");
  if (cells_v < 1) reject("cells_v", cells_v, "at least 1");
  require_positive("mass", mass);
  require_positive("area", u.cross(v).norm());

  const Vec3 step_u = u / cells_u, step_v = v / cells_v;
  const double cell_mass = mass / cells_u / cells_v;
  const auto index = [&](int a, int b) { return a + b * (cells_u + 1); };

  Net net;
  for (int b = 0; b <= cells_v; ++b)
    for (int a = 0; a <= cells_u; ++a) {
      net.x.push_back(corner + (a / cells_u) * u + (b / cells_v) * v);
      if (a > 0) net.links.push_back({.i = index(a - 1, b), .j = index(a, b), .length = step_u.norm()});
      if (b > 0) net.links.push_back({.i = index(a, b - 1), .j = index(a, b), .length = step_v.norm()});
    }

  net.mass.assign(net.x.size(), 0);
  for (int b = 0; b < cells_v; ++b)
    for (int a = 0; a < cells_u; ++a)
      for (const int point : {index(a, b), index(a + 1, b), index(a, b + 1), index(a + 1, b + 1)})
        net.mass[static_cast<std::size_t>(point)] += cell_mass / 4;  // Eq. (6.11)
  return net;
}

}  // namespace spook
