#pragma once
// The order in which the nodes of a graph are eliminated, and what each then acts on.
//
//   order      for little fill: Eigen's AMD                                                         as Eq. (11.3)
//   pattern    the later neighbours of a node; eliminating the node makes them neighbours of each other
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <utility>
#include <vector>

namespace spook {

struct Elimination {
  std::vector<int> place;               ///< of each node in the order
  std::vector<std::vector<int>> later;  ///< places of the later neighbours of each place, ascending
};

/// Analyses a graph of `count` nodes with an edge for each pair, which may occur repeatedly.
inline Elimination eliminate(int count, const std::vector<std::pair<int, int>>& pairs) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int node = 0; node < count; ++node) entries.emplace_back(node, node, 1);
  for (const auto& [i, j] : pairs) {
    entries.emplace_back(i, j, 1);
    entries.emplace_back(j, i, 1);
  }
  Eigen::SparseMatrix<double> graph(count, count);
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::AMDOrdering<int>::PermutationType order;
  Eigen::AMDOrdering<int>()(graph, order);

  Elimination found{.place = std::vector<int>(count), .later = std::vector<std::vector<int>>(count)};
  for (int p = 0; p < count; ++p) found.place[order.indices()[p]] = p;
  for (const auto& [i, j] : pairs) {
    const auto [low, high] = std::minmax(found.place[i], found.place[j]);
    found.later[low].push_back(high);
  }
  for (std::vector<int>& all : found.later) {
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    if (!all.empty()) {
      std::vector<int>& next = found.later[all.front()];
      next.insert(next.end(), all.begin() + 1, all.end());
    }
  }
  return found;
}

}  // namespace spook
