#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>

#include "08_pairs/grid_cells.hpp"
#include "08_pairs/pairs.hpp"
#include "08_pairs/touching_bounds.hpp"

namespace spook {

namespace {

/// The bodies in each cell. Cells with equal hashes share a list, in which a body occurs once.
class Table {
 public:
  explicit Table(std::size_t bodies) : last_(std::bit_ceil(8 * bodies), -1) { entries_.reserve(8 * bodies); }

  void enter(int body, const Cell& cell, int level) {
    int& last = last_[slot(cell, level)];
    if (last >= 0 && entries_[static_cast<std::size_t>(last)].body == body) return;
    entries_.push_back({body, last});
    last = static_cast<int>(entries_.size()) - 1;
  }

  template <class Visit>
  void visit(const Cell& cell, int level, const Visit& each) const {
    for (int k = last_[slot(cell, level)]; k >= 0; k = entries_[static_cast<std::size_t>(k)].before)
      each(entries_[static_cast<std::size_t>(k)].body);
  }

 private:
  struct Entry {
    int body, before;
  };

  std::size_t slot(const Cell& cell, int level) const {
    auto mixed = static_cast<std::uint64_t>(level);
    for (const std::int64_t number : cell) {
      mixed = (mixed ^ static_cast<std::uint64_t>(number)) * 0x9E3779B97F4A7C15u;
      mixed ^= mixed >> 32;
    }
    return mixed & (last_.size() - 1);
  }

  std::vector<int> last_;  // the last entry of each list; -1: empty
  std::vector<Entry> entries_;
};

}  // namespace

std::vector<Pair> spatial_hash(const std::vector<Bounds>& bounds) {
  require_sound(bounds);
  std::vector<int> level, order(bounds.size());
  for (const Bounds& one : bounds) level.push_back(level_of(one));
  const auto level_of_body = [&](int body) { return level[static_cast<std::size_t>(body)]; };
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return level_of_body(a) > level_of_body(b); });

  // From large to small: each body is compared with earlier bodies of its own and of all coarser levels, then added.
  Table table(bounds.size());
  std::vector<Grid> grids;
  std::vector<Pair> pairs;
  for (const int body : order) {
    const Bounds& one = bounds[static_cast<std::size_t>(body)];
    if (grids.empty() || grids.back().level() != level_of_body(body)) grids.emplace_back(level_of_body(body));
    for (const Grid& grid : grids)
      grid.for_each_cell(one, [&](const Cell& cell) {
        table.visit(cell, grid.level(), [&](int other) {
          const Bounds& two = bounds[static_cast<std::size_t>(other)];
          // They may share several cells; that of the lower corner of their overlap tells of them.     Eq. (8.14)
          if (touch(one, two) && level_of_body(other) == grid.level() &&
              grid.cell_of(one.lower.cwiseMax(two.lower)) == cell)
            pairs.push_back(std::minmax(body, other));
        });
      });
    grids.back().for_each_cell(one, [&](const Cell& cell) { table.enter(body, cell, grids.back().level()); });
  }
  sort_pairs(pairs, bounds.size());
  return pairs;
}

}  // namespace spook
