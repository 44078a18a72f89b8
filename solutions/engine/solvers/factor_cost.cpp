#include "engine/solvers/factor_cost.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "engine/linear/body_numbers.hpp"
#include "engine/linear/elimination.hpp"
#include "engine/solvers/islands.hpp"

namespace spook {

namespace {

constexpr double multiplications_of_row = 25;  // of an update, Eq. (4.7)

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

/// Tells whether so many velocities are the cheaper unknowns. Rows with bounds count twice, since their bounds cost
/// factorisations over rows.
template <int Dof>
bool fewer_than(const std::vector<Row<Dof>>& rows, int velocities) {
  std::ptrdiff_t count = 0;
  for (const Row<Dof>& row : rows) count += is_bounded(row) ? 2 : 1;
  return count > 2 * velocities;
}

/// Returns the levels of bodies from one end of an island.
template <int Dof>
std::vector<int> levels_of(const std::vector<Row<Dof>>& rows) {
  const RowsOnBodies on_bodies(rows);
  int end = moves_i(rows.front()) ? rows.front().i : rows.front().j;
  body_levels(rows, on_bodies, end);  // finds an end of the island
  return body_levels(rows, on_bodies, end);
}

template <int Dof>
double on_velocities(const std::vector<Row<Dof>>& rows, int bodies, const std::vector<int>& levels) {
  const double w = Dof * widest(levels);
  return w * w * Dof * bodies / (multiplications_of_row * static_cast<double>(rows.size()));
}

/// Returns the bound of factors over rows. The level of a row is the smaller level of its bodies.
template <int Dof>
double on_rows(const std::vector<Row<Dof>>& rows, const std::vector<int>& levels) {
  std::vector<int> of_rows;
  for (const Row<Dof>& row : rows) {
    const int i = moves_i(row) ? levels[row.i] : levels[row.j], j = moves_j(row) ? levels[row.j] : i;
    of_rows.push_back(std::min(i, j));
  }
  const double w = widest(of_rows);
  return w * w / multiplications_of_row;
}

/// Returns the multiplications of symmetric factors of a graph whose nodes have so many unknowns each.
double multiplications(const std::vector<int>& unknowns, const std::vector<std::pair<int, int>>& pairs) {
  const Elimination order = eliminate(static_cast<int>(unknowns.size()), pairs);
  std::vector<double> of_place(unknowns.size());
  for (std::size_t node = 0; node < unknowns.size(); ++node) of_place[order.place[node]] = unknowns[node];
  double sum = 0;
  for (std::size_t p = 0; p < of_place.size(); ++p) {
    double below = of_place[p];
    for (const int later : order.later[p]) below += of_place[later];
    sum += of_place[p] * below * below / 2;
  }
  return sum;
}

/// Returns the multiplications of factors over velocities.
template <int Dof>
double count_on_velocities(const std::vector<Row<Dof>>& rows) {
  BodyNumbers number;
  number.begin(bodies_of(rows));
  std::vector<std::pair<int, int>> pairs;
  for (const Row<Dof>& row : rows) {
    for_moving(row, [&](int body) { number.add(body); });
    if (moves_i(row) && moves_j(row)) pairs.emplace_back(number[row.i], number[row.j]);
  }
  return multiplications(std::vector<int>(number.bodies().size(), Dof), pairs);
}

/// Returns the multiplications of factors over rows. The rows of a joint are one node, and those on a body are
/// neighbours of each other.
template <int Dof>
double count_on_rows(const std::vector<Row<Dof>>& rows, const RowsOnBodies& on_bodies) {
  std::vector<int> unknowns, node_of;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const bool follows = k > 0 && rows[k].i == rows[k - 1].i && rows[k].j == rows[k - 1].j;
    if (!follows) unknowns.push_back(0);
    ++unknowns.back();
    node_of.push_back(static_cast<int>(unknowns.size()) - 1);
  }
  std::vector<std::pair<int, int>> pairs;
  for (int body = 0; body < std::ssize(on_bodies); ++body) {
    std::vector<int> nodes;
    for (const int k : on_bodies[body])
      if (nodes.empty() || nodes.back() != node_of[k]) nodes.push_back(node_of[k]);
    for (std::size_t n = 0; n < nodes.size(); ++n)
      for (std::size_t m = 0; m < n; ++m) pairs.emplace_back(nodes[n], nodes[m]);
  }
  return multiplications(unknowns, pairs);
}

/// Returns a lower bound of the multiplications of factors over rows: all rows on one body are neighbours of each
/// other.
double least_on_rows(const RowsOnBodies& on_bodies) {
  std::size_t most = 0;
  for (int body = 0; body < std::ssize(on_bodies); ++body) most = std::max(most, on_bodies[body].size());
  return std::pow(static_cast<double>(most), 3) / 6;
}

}  // namespace

template <int Dof>
bool wants_bodies(const std::vector<Row<Dof>>& rows) {
  return fewer_than(rows, Dof * moving_bodies(rows));
}

template <int Dof>
double velocity_factor_cost(const std::vector<Row<Dof>>& rows) {
  const int bodies = moving_bodies(rows);
  return bodies == 0 ? 0 : on_velocities(rows, bodies, levels_of(rows));
}

template <int Dof>
double counted_velocity_factor_cost(const std::vector<Row<Dof>>& rows) {
  return count_on_velocities(rows) / (multiplications_of_row * static_cast<double>(rows.size()));
}

template <int Dof>
double factor_cost(const std::vector<Row<Dof>>& rows, double affordable) {
  const int bodies = moving_bodies(rows);
  if (bodies == 0) return 0;
  const std::vector<int> levels = levels_of(rows);
  const bool by_velocities = fewer_than(rows, Dof * bodies);
  const double bound = by_velocities ? on_velocities(rows, bodies, levels) : on_rows(rows, levels);
  if (bound <= affordable || std::any_of(rows.begin(), rows.end(), is_bounded<Dof>)) return bound;
  if (by_velocities) return std::min(bound, counted_velocity_factor_cost(rows));
  const double sweep = multiplications_of_row * static_cast<double>(rows.size());
  const RowsOnBodies on_bodies(rows);
  if (least_on_rows(on_bodies) > affordable * sweep) return bound;
  return std::min(bound, count_on_rows(rows, on_bodies) / sweep);
}

template bool wants_bodies<3>(const std::vector<Row<3>>&);
template bool wants_bodies<6>(const std::vector<Row<6>>&);
template double factor_cost<3>(const std::vector<Row<3>>&, double);
template double factor_cost<6>(const std::vector<Row<6>>&, double);
template double velocity_factor_cost<3>(const std::vector<Row<3>>&);
template double velocity_factor_cost<6>(const std::vector<Row<6>>&);
template double counted_velocity_factor_cost<3>(const std::vector<Row<3>>&);
template double counted_velocity_factor_cost<6>(const std::vector<Row<6>>&);

}  // namespace spook
