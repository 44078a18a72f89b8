#include <algorithm>

#include "14_fast_rows/fast_rows.hpp"

namespace spook {

std::vector<int> colour_pairs(const std::vector<Pair>& pairs, std::size_t bodies) {
  std::vector<std::vector<bool>> taken(bodies);  // of each body, by colour
  const auto has = [&](int body, std::size_t colour) {
    return body >= 0 && colour < taken[body].size() && taken[body][colour];
  };
  std::vector<int> all;
  for (const Pair& pair : pairs) {
    std::size_t colour = 0;
    while (has(pair.first, colour) || has(pair.second, colour)) ++colour;  // Eq. (14.7)
    for (const int body : {pair.first, pair.second}) {
      if (body < 0) continue;
      if (taken[body].size() <= colour) taken[body].resize(colour + 1, false);
      taken[body][colour] = true;
    }
    all.push_back(static_cast<int>(colour));
  }
  return all;
}

}  // namespace spook
