// Wrong: takes the mass for that of a metre.
// Killed by: Rope.PutsHalfOfEachLinkOnEitherEnd
// Says: `mass` is taken for that of 1 m
#include "06_distance/distance.hpp"
#include "common/require.hpp"

namespace spook {

Net rope(const Vec3& from, const Vec3& to, int links, double mass) {
  require_all_finite("from", from);
  require_all_finite("to", to);
  if (links < 1) reject("links", links, "at least 1");
  require_positive("mass", mass);
  require_positive("length", (to - from).norm());

  Net net;
  const double length = (to - from).norm() / links;
  for (int k = 0; k <= links; ++k) net.x.push_back(from + (to - from) * (static_cast<double>(k) / links));
  net.mass.assign(net.x.size(), 0);
  for (int k = 0; k < links; ++k) {
    net.links.push_back({.i = k, .j = k + 1, .length = length});
    for (const int end : {k, k + 1})
      net.mass[static_cast<std::size_t>(end)] += mass * length / 2;  // Eq. (6.10)
  }
  return net;
}

}  // namespace spook
