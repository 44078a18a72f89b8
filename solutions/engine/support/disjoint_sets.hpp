#pragma once
// Disjoint sets of the numbers 0, 1, ..., joined two at a time.
#include <cstddef>
#include <numeric>
#include <vector>

namespace spook {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// Returns a number that stands for the whole set of `a`, until that is joined with another.
  int find(int a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }

  void join(int a, int b) { parent_[find(a)] = find(b); }

 private:
  std::vector<int> parent_;
};

}  // namespace spook
