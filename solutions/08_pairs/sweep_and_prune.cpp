#include <algorithm>

#include "08_pairs/pairs.hpp"
#include "08_pairs/touching_bounds.hpp"

namespace spook {

namespace {

struct Entry {
  Bounds bounds;
  int body;
};

/// Returns the axis along which the centres are spread most: there the fewest intervals overlap.
int widest_axis(const std::vector<Bounds>& bounds) {
  Eigen::Matrix3Xd centres(3, bounds.size());  // twice the centres
  for (std::size_t k = 0; k < bounds.size(); ++k) centres.col(k) = bounds[k].lower + bounds[k].upper;
  int axis;
  (centres.colwise() - centres.rowwise().mean()).rowwise().squaredNorm().maxCoeff(&axis);
  return axis;
}

}  // namespace

std::vector<Pair> sweep_and_prune(const std::vector<Bounds>& bounds) {
  require_sound(bounds);
  std::vector<Pair> pairs;
  const int axis = widest_axis(bounds);
  std::vector<Entry> entries;
  for (std::size_t k = 0; k < bounds.size(); ++k) entries.push_back({bounds[k], static_cast<int>(k)});
  std::sort(entries.begin(), entries.end(),
            [axis](const Entry& a, const Entry& b) { return a.bounds.lower[axis] < b.bounds.lower[axis]; });

  // Whoever begins behind the end of one is out of its reach, and so are all that follow.         Eq. (8.12)
  for (auto one = entries.begin(); one != entries.end(); ++one)
    for (auto other = one + 1; other != entries.end(); ++other) {
      if (other->bounds.lower[axis] > one->bounds.upper[axis]) break;
      if (touch(one->bounds, other->bounds)) pairs.push_back(std::minmax(one->body, other->body));
    }
  sort_pairs(pairs, bounds.size());
  return pairs;
}

}  // namespace spook
