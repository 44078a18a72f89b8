#include "engine/islands.hpp"

#include <algorithm>
#include <numeric>

namespace spook {

namespace {

/// Which of some things belong together.
class Groups {
 public:
  explicit Groups(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }

  int find(int a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void join(int a, int b) { parent_[find(a)] = find(b); }

 private:
  std::vector<int> parent_;
};

/// The rows on each body, as far as it moves.
using RowsOnBodies = std::vector<std::vector<int>>;

template <int Dof>
RowsOnBodies rows_on_bodies(const std::vector<Row<Dof>>& rows) {
  RowsOnBodies all;
  const auto add = [&](int body, int row) {
    if (body >= std::ssize(all)) all.resize(static_cast<std::size_t>(body) + 1);
    all[body].push_back(row);
  };
  for (int k = 0; k < std::ssize(rows); ++k) {
    if (moves_i(rows[k])) add(rows[k].i, k);
    if (moves_j(rows[k])) add(rows[k].j, k);
  }
  return all;
}

/// Level by level from `start`: the level of each row is that of the first of its bodies to be reached. The last body
/// reached is left in `start`.
template <int Dof>
std::vector<int> row_levels(const std::vector<Row<Dof>>& rows, const RowsOnBodies& on_bodies, int& start) {
  std::vector<int> levels(rows.size(), -1), body_level(on_bodies.size(), -1), queue = {start};
  body_level[start] = 0;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const int body = queue[next];
    for (const int k : on_bodies[body]) {
      if (levels[k] < 0) levels[k] = body_level[body];
      const auto reach = [&](int other) {
        if (body_level[other] >= 0) return;
        body_level[other] = body_level[body] + 1;
        queue.push_back(other);
      };
      if (moves_i(rows[k])) reach(rows[k].i);
      if (moves_j(rows[k])) reach(rows[k].j);
    }
  }
  start = queue.back();
  return levels;
}

}  // namespace

template <int Dof>
std::vector<std::vector<int>> islands(const std::vector<Row<Dof>>& rows, std::size_t bodies) {
  Groups groups(bodies);
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

template <int Dof>
int width(const std::vector<Row<Dof>>& rows) {
  const RowsOnBodies on_bodies = rows_on_bodies(rows);
  if (on_bodies.empty()) return std::min<int>(1, static_cast<int>(rows.size()));
  int end = moves_i(rows.front()) ? rows.front().i : rows.front().j;
  row_levels(rows, on_bodies, end);  // to one of its ends
  std::vector<int> in_level;
  for (const int level : row_levels(rows, on_bodies, end)) {
    if (level >= std::ssize(in_level)) in_level.resize(static_cast<std::size_t>(level) + 1, 0);
    if (level >= 0) ++in_level[level];
  }
  int widest = in_level.front();
  for (std::size_t level = 1; level < in_level.size(); ++level)
    widest = std::max(widest, in_level[level - 1] + in_level[level]);
  return widest;
}

template <int Dof>
double mass_ratio(const std::vector<Row<Dof>>& rows) {
  double largest = 1;
  for (const Row<Dof>& row : rows) {
    const double i = row.Gi.dot(row.MinvGi), j = row.Gj.dot(row.MinvGj);
    if (i > 0 && j > 0) largest = std::max({largest, i / j, j / i});
  }
  return largest;
}

template <int Dof>
bool wants_direct(const std::vector<Row<Dof>>& rows, const StopRule& stop) {
  const double w = width(rows), sweeps = w * w / 25;
  return sweeps <= stop.max_sweeps || (mass_ratio(rows) > stop.max_sweeps && sweeps <= 100.0 * stop.max_sweeps);
}

template std::vector<std::vector<int>> islands<3>(const std::vector<Row<3>>&, std::size_t);
template std::vector<std::vector<int>> islands<6>(const std::vector<Row<6>>&, std::size_t);
template int width<3>(const std::vector<Row<3>>&);
template int width<6>(const std::vector<Row<6>>&);
template double mass_ratio<3>(const std::vector<Row<3>>&);
template double mass_ratio<6>(const std::vector<Row<6>>&);
template bool wants_direct<3>(const std::vector<Row<3>>&, const StopRule&);
template bool wants_direct<6>(const std::vector<Row<6>>&, const StopRule&);

}  // namespace spook
