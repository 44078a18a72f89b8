#include "engine/islands.hpp"

#include <algorithm>
#include <cmath>
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

/// Level by level from `start`: how far each body is from it, -1 where it is not reached. The last to be reached is left
/// in `start`.
template <int Dof>
std::vector<int> body_levels(const std::vector<Row<Dof>>& rows, const RowsOnBodies& on_bodies, int& start) {
  std::vector<int> levels(on_bodies.size(), -1), queue = {start};
  levels[start] = 0;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const int body = queue[next];
    for (const int k : on_bodies[body]) {
      const auto reach = [&](int other) {
        if (levels[other] >= 0) return;
        levels[other] = levels[body] + 1;
        queue.push_back(other);
      };
      if (moves_i(rows[k])) reach(rows[k].i);
      if (moves_j(rows[k])) reach(rows[k].j);
    }
  }
  start = queue.back();
  return levels;
}

/// How many of some things are in two neighbouring levels, at most.
int widest(const std::vector<int>& levels) {
  std::vector<int> in_level(1, 0);
  for (const int level : levels) {
    if (level >= std::ssize(in_level)) in_level.resize(static_cast<std::size_t>(level) + 1, 0);
    if (level >= 0) ++in_level[level];
  }
  int most = in_level.front();
  for (std::size_t level = 1; level < in_level.size(); ++level)
    most = std::max(most, in_level[level - 1] + in_level[level]);
  return most;
}

int moving_bodies(const RowsOnBodies& on_bodies) {
  const auto moves = [](const std::vector<int>& rows) { return !rows.empty(); };
  return static_cast<int>(std::count_if(on_bodies.begin(), on_bodies.end(), moves));
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

/// Whether so many velocities are the cheaper unknowns. What has bounds counts twice: on rows they cost factorisations.
template <int Dof>
static bool fewer_than(const std::vector<Row<Dof>>& rows, int velocities) {
  std::ptrdiff_t count = 0;
  for (const Row<Dof>& row : rows) count += std::isfinite(row.lo) || std::isfinite(row.hi) ? 2 : 1;
  return count > 2 * velocities;
}

template <int Dof>
bool wants_bodies(const std::vector<Row<Dof>>& rows) {
  return fewer_than(rows, Dof * moving_bodies(rows_on_bodies(rows)));
}

template <int Dof>
double factor_cost(const std::vector<Row<Dof>>& rows) {
  const RowsOnBodies on_bodies = rows_on_bodies(rows);
  if (on_bodies.empty()) return 0;
  const auto n = static_cast<double>(rows.size());
  int end = moves_i(rows.front()) ? rows.front().i : rows.front().j;
  body_levels(rows, on_bodies, end);  // to one of its ends
  const std::vector<int> levels = body_levels(rows, on_bodies, end);
  if (const int velocities = Dof * moving_bodies(on_bodies); fewer_than(rows, velocities)) {
    const double w = Dof * widest(levels);
    return w * w * velocities / (25 * n);
  }
  // The level of a row is that of the first of its bodies to be reached.
  std::vector<int> of_rows;
  for (const Row<Dof>& row : rows) {
    const int i = moves_i(row) ? levels[row.i] : levels[row.j], j = moves_j(row) ? levels[row.j] : i;
    of_rows.push_back(std::min(i, j));
  }
  const double w = widest(of_rows);
  return w * w / 25;
}

template std::vector<std::vector<int>> islands<3>(const std::vector<Row<3>>&, std::size_t);
template std::vector<std::vector<int>> islands<6>(const std::vector<Row<6>>&, std::size_t);
template bool wants_bodies<3>(const std::vector<Row<3>>&);
template bool wants_bodies<6>(const std::vector<Row<6>>&);
template double factor_cost<3>(const std::vector<Row<3>>&);
template double factor_cost<6>(const std::vector<Row<6>>&);

}  // namespace spook
