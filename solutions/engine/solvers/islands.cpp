#include "engine/solvers/islands.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "engine/support/disjoint_sets.hpp"

namespace spook {

namespace {

/// Calls `each` with the dynamic bodies of a row.
template <int Dof, class Each>
void for_moving(const Row<Dof>& row, const Each& each) {
  if (moves_i(row)) each(row.i);
  if (moves_j(row)) each(row.j);
}

template <int Dof>
std::size_t bodies_of(const std::vector<Row<Dof>>& rows) {
  int last = -1;
  for (const Row<Dof>& row : rows) last = std::max({last, row.i, row.j});
  return static_cast<std::size_t>(last) + 1;
}

/// The rows on each dynamic body, in one list for all bodies.
class RowsOnBodies {
 public:
  template <int Dof>
  explicit RowsOnBodies(const std::vector<Row<Dof>>& rows) : first_(bodies_of(rows) + 1, 0) {
    for (const Row<Dof>& row : rows) for_moving(row, [&](int body) { ++first_[body + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    all_.resize(first_.back());
    std::vector<int> next = first_;
    for (int k = 0; k < std::ssize(rows); ++k) for_moving(rows[k], [&](int body) { all_[next[body]++] = k; });
  }

  std::size_t size() const { return first_.size() - 1; }
  std::span<const int> operator[](int body) const {
    return std::span(all_).subspan(first_[body], first_[body + 1] - first_[body]);
  }

 private:
  std::vector<int> first_, all_;
};

/// Returns the level of each body, counted from `start`; -1 if it is not reached. Sets `start` to the last body
/// reached.
template <int Dof>
std::vector<int> body_levels(const std::vector<Row<Dof>>& rows, const RowsOnBodies& on_bodies, int& start) {
  std::vector<int> levels(on_bodies.size(), -1), queue = {start};
  levels[start] = 0;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const int body = queue[next];
    for (const int k : on_bodies[body])
      for_moving(rows[k], [&](int other) {
        if (levels[other] >= 0) return;
        levels[other] = levels[body] + 1;
        queue.push_back(other);
      });
  }
  start = queue.back();
  return levels;
}

/// Returns the largest number of items in two neighbouring levels.
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

/// Returns the number of dynamic bodies of the rows. Skips rows on the same two bodies as the row before, as most rows
/// are.
template <int Dof>
int moving_bodies(const std::vector<Row<Dof>>& rows) {
  std::vector<bool> moves(bodies_of(rows), false);
  int count = 0;
  const Row<Dof>* last = nullptr;
  for (const Row<Dof>& row : rows) {
    if (last && row.i == last->i && row.j == last->j) continue;
    last = &row;
    if (!moves[row.i] && moves_i(row)) moves[row.i] = true, ++count;
    if (!moves[row.j] && moves_j(row)) moves[row.j] = true, ++count;
  }
  return count;
}

}  // namespace

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

/// Tells whether so many velocities are the cheaper unknowns. Rows with bounds count twice, since their bounds cost
/// factorisations over rows.
template <int Dof>
static bool fewer_than(const std::vector<Row<Dof>>& rows, int velocities) {
  std::ptrdiff_t count = 0;
  for (const Row<Dof>& row : rows) count += std::isfinite(row.lo) || std::isfinite(row.hi) ? 2 : 1;
  return count > 2 * velocities;
}

template <int Dof>
bool wants_bodies(const std::vector<Row<Dof>>& rows) {
  return fewer_than(rows, Dof * moving_bodies(rows));
}

/// Returns the levels of bodies from one end of an island.
template <int Dof>
static std::vector<int> levels_of(const std::vector<Row<Dof>>& rows) {
  const RowsOnBodies on_bodies(rows);
  int end = moves_i(rows.front()) ? rows.front().i : rows.front().j;
  body_levels(rows, on_bodies, end);  // finds an end of the island
  return body_levels(rows, on_bodies, end);
}

template <int Dof>
static double on_velocities(const std::vector<Row<Dof>>& rows, int bodies, const std::vector<int>& levels) {
  const double w = Dof * widest(levels);
  return w * w * Dof * bodies / (25 * static_cast<double>(rows.size()));
}

template <int Dof>
double velocity_factor_cost(const std::vector<Row<Dof>>& rows) {
  const int bodies = moving_bodies(rows);
  return bodies == 0 ? 0 : on_velocities(rows, bodies, levels_of(rows));
}

template <int Dof>
double factor_cost(const std::vector<Row<Dof>>& rows) {
  const int bodies = moving_bodies(rows);
  if (bodies == 0) return 0;
  const std::vector<int> levels = levels_of(rows);
  if (fewer_than(rows, Dof * bodies)) return on_velocities(rows, bodies, levels);
  // The level of a row is the smaller level of its bodies.
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
template double velocity_factor_cost<3>(const std::vector<Row<3>>&);
template double velocity_factor_cost<6>(const std::vector<Row<6>>&);

}  // namespace spook
