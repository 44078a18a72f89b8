#pragma once
// Which solids are near each other, remembered from step to step.
//
// Most bodies move by little in a step. Bounds with some room around them have pairs, from a broad phase; as long as nothing
// has left its own, no other pair can touch. A few that have left get new ones, and are compared with all others. A body
// at rest is skipped by later broad phases.
#include <vector>

#include "08_pairs/pairs.hpp"

namespace spook {

class PairCache {
 public:
  /// The pairs whose bounds touch, in order. Throws std::invalid_argument that names lower or upper if one is not finite.
  const std::vector<Pair>& touching(const std::vector<Bounds>& bounds);

 private:
  void give_all_room(const std::vector<Bounds>& bounds);
  void give_room(const std::vector<int>& these, const std::vector<Bounds>& bounds);

  std::vector<Bounds> roomy_;  // what near_ are the pairs of
  std::vector<Pair> near_, touching_;
};

}  // namespace spook
