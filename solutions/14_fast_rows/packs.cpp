// Conversion between rows and packs.
#include <algorithm>
#include <span>

#include "14_fast_rows/fast_rows.hpp"

namespace spook {

namespace {

/// Consecutive rows of the same two bodies: all of contacts with friction, or none.
struct Run {
  int first, count;
  bool rubs;
};

/// `mu`: of each row that is a contact's, else -1.
template <int Dof>
std::vector<Run> runs_of(const std::vector<Row<Dof>>& rows, const std::vector<double>& mu) {
  std::vector<Run> runs;
  for (int k = 0; k < std::ssize(rows); ++k) {
    const bool rubs = mu[k] >= 0;
    if (k > 0 && rows[k - 1].i == rows[k].i && rows[k - 1].j == rows[k].j && runs.back().rubs == rubs)
      ++runs.back().count;
    else
      runs.push_back({.first = k, .count = 1, .rubs = rubs});
  }
  return runs;
}

template <int Dof>
void put(const Row<Dof>& row, int lane, LaneRows<Dof>& into) {
  into.Gi.row(lane) = row.Gi.array();
  into.Gj.row(lane) = row.Gj.array();
  into.MinvGi.row(lane) = row.MinvGi.array();
  into.MinvGj.row(lane) = row.MinvGj.array();
  into.B[lane] = row.B, into.Sigma[lane] = row.Sigma, into.diagonal[lane] = row.diagonal;
  into.lo[lane] = row.lo, into.hi[lane] = row.hi, into.lambda[lane] = row.lambda;
}

}  // namespace

template <int Dof>
std::vector<Colour<Dof>> packed(const std::vector<Row<Dof>>& rows, std::size_t bodies,
                                const std::vector<FrictionContact>& contacts) {
  std::vector<double> mu(rows.size(), -1.0);
  for (const FrictionContact& contact : contacts) std::fill_n(&mu[contact.normal], 3, contact.mu);
  const std::vector<Run> runs = runs_of(rows, mu);
  std::vector<Pair> pairs;
  for (const Run& run : runs) {
    const std::span of(&rows[run.first], static_cast<std::size_t>(run.count));
    const bool moves_i =
                   std::any_of(of.begin(), of.end(), [](const auto&row) { return !row.MinvGi.isZero(0); }),
               moves_j =
                   std::any_of(of.begin(), of.end(), [](const auto&row) { return !row.MinvGj.isZero(0); });
    pairs.emplace_back(moves_i ? of[0].i : -1, moves_j ? of[0].j : -1);
  }
  const std::vector<int> colour = colour_pairs(pairs, bodies);
  std::vector<std::vector<int>> members(
      colour.empty() ? 0 : static_cast<std::size_t>(*std::max_element(colour.begin(), colour.end())) + 1);
  for (int k = 0; k < std::ssize(runs); ++k) members[colour[k]].push_back(k);

  std::vector<Colour<Dof>> all(members.size());
  for (std::size_t c = 0; c < all.size(); ++c) {
    // The longest first, so that rows side by side have similar lengths; those of contacts last, in packs of their own.
    std::stable_sort(members[c].begin(), members[c].end(), [&](int a, int b) {
      return runs[a].rubs != runs[b].rubs ? runs[b].rubs : runs[a].count > runs[b].count;
    });
    int lane = lane_count - 1;
    bool rubs = false;
    for (const int run : members[c]) {
      lane = rubs == runs[run].rubs ? (lane + 1) % lane_count : 0;
      rubs = runs[run].rubs;
      if (lane == 0) {
        const auto count = static_cast<std::size_t>(runs[run].count);
        all[c].push_back({.rows = std::vector<LaneRows<Dof>>(count),
                          .mu = std::vector<Lanes>(rubs ? count / 3 : 0, Lanes::Zero())});
      }
      Pack<Dof>& pack = all[c].back();
      pack.i[lane] = pairs[run].first;
      pack.j[lane] = pairs[run].second;
      pack.first[lane] = runs[run].first;
      for (int m = 0; m < runs[run].count; ++m) put(rows[runs[run].first + m], lane, pack.rows[m]);
      for (std::size_t m = 0; rubs && 3 * m < static_cast<std::size_t>(runs[run].count); ++m)
        pack.mu[m][lane] = mu[static_cast<std::size_t>(runs[run].first) + 3 * m];
    }
  }
  return all;
}

template <int Dof>
void unpack(const std::vector<Colour<Dof>>& colours, std::vector<Row<Dof>>& rows) {
  for (const Colour<Dof>& colour : colours)
    for (const Pack<Dof>& pack : colour)
      for (int lane = 0; lane < lane_count; ++lane) {
        if (pack.first[lane] < 0) continue;
        const Row<Dof>& first = rows[pack.first[lane]];
        for (std::size_t m = 0; m < pack.rows.size(); ++m) {
          const std::size_t k = static_cast<std::size_t>(pack.first[lane]) + m;
          if (k == rows.size() || rows[k].i != first.i || rows[k].j != first.j) break;
          rows[k].lambda = pack.rows[m].lambda[lane];
        }
      }
}

template std::vector<Colour<3>> packed<3>(const std::vector<Row<3>>&, std::size_t,
                                          const std::vector<FrictionContact>&);
template std::vector<Colour<6>> packed<6>(const std::vector<Row<6>>&, std::size_t,
                                          const std::vector<FrictionContact>&);
template void unpack<3>(const std::vector<Colour<3>>&, std::vector<Row<3>>&);
template void unpack<6>(const std::vector<Colour<6>>&, std::vector<Row<6>>&);

}  // namespace spook
