#include "engine/solvers/islands.hpp"

#include "engine/support/disjoint_sets.hpp"

namespace spook {

template <int Dof>
std::vector<std::vector<int>> islands(const std::vector<Row<Dof>>& rows, std::size_t bodies) {
  DisjointSets groups(bodies);
  for (const Row<Dof>& row : rows)
    if (moves_i(row) && moves_j(row)) groups.join(row.i, row.j);
  std::vector<std::vector<int>> all;
  std::vector<int> number(bodies, -1);
  for (int k = 0; k < std::ssize(rows); ++k) {
    const bool i = moves_i(rows[k]), j = moves_j(rows[k]);
    int* island = i ? &number[groups.find(rows[k].i)] : j ? &number[groups.find(rows[k].j)] : nullptr;
    if (island && *island >= 0) {
      all[*island].push_back(k);
    } else {
      if (island) *island = static_cast<int>(all.size());
      all.push_back({k});
    }
  }
  return all;
}

template std::vector<std::vector<int>> islands<3>(const std::vector<Row<3>>&, std::size_t);
template std::vector<std::vector<int>> islands<6>(const std::vector<Row<6>>&, std::size_t);

}  // namespace spook
