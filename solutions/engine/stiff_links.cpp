#include "engine/stiff_links.hpp"

#include "engine/islands.hpp"

namespace spook {

std::vector<Stiffness> link_stiffness(const std::vector<Joint>& joints, const std::vector<double>& impulses,
                                      const Bodies<3>& bodies, double h) {
  std::vector<Stiffness> all;
  std::size_t row = 0;
  for (const Joint& joint : joints) {
    const std::size_t first = row;
    row += static_cast<std::size_t>(joint.rows());
    if (row > impulses.size()) break;
    if (!joint.length) continue;  // a ball joint has no length that could turn
    const Vec3 along =
        bodies.x[static_cast<std::size_t>(joint.j)] - bodies.x[static_cast<std::size_t>(joint.i)];
    const double length = along.norm(), tension = -impulses[first] / h;
    if (tension > 0)
      all.push_back({.i = joint.i, .j = joint.j, .K = geometric_stiffness(along / length, length, tension)});
  }
  return all;
}

std::vector<bool> free_of_contacts(const std::vector<Row<3>>& rows, std::size_t first, std::size_t bodies) {
  std::vector<bool> free(rows.size(), true);
  if (first == rows.size()) return free;
  for (const std::vector<int>& island : islands(rows, bodies)) {
    if (island.back() < static_cast<int>(first)) continue;  // rows of contacts come last
    for (const int k : island) free[static_cast<std::size_t>(k)] = false;
  }
  return free;
}

}  // namespace spook
