#include "scenes/pairwise.hpp"

#include <cstddef>

namespace spook {

std::vector<double> pair_by_pair(std::vector<double> v, double restitution, double threshold) {
  for (bool quiet = false; !quiet;) {
    quiet = true;
    for (std::size_t i = 0; i + 1 < v.size(); ++i) {
      const double approach = v[i] - v[i + 1];
      if (!(approach > threshold)) continue;
      const double middle = (v[i] + v[i + 1]) / 2;
      v[i] = middle - restitution * approach / 2;
      v[i + 1] = middle + restitution * approach / 2;
      quiet = false;
    }
  }
  return v;
}

}  // namespace spook
