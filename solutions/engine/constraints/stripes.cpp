#include "engine/constraints/stripes.hpp"

#include <algorithm>
#include <cmath>

#include "engine/support/parallel_for.hpp"

namespace spook {

namespace {

/// Returns the axis along which consecutive bodies are closest, relative to the extent of all bodies. So consecutive
/// items, which are also close in memory, belong to one stripe.
template <int Dof>
int axis_across(const std::vector<int>& moving, const Bodies<Dof>& bodies) {
  Eigen::Array3d steps = Eigen::Array3d::Zero();
  Eigen::AlignedBox3d all;
  for (std::size_t k = 0; k < moving.size(); ++k) {
    const Vec3& x = bodies.x[moving[k]];
    all.extend(x);
    if (k > 0) steps += (x - bodies.x[moving[k - 1]]).array().abs();
  }
  int axis = 0;
  for (int other = 1; other < 3; ++other)
    if (steps[other] * all.sizes()[axis] < steps[axis] * all.sizes()[other]) axis = other;
  return axis;
}

/// Returns the rank of each dynamic body along the axis; -1 for the others.
template <int Dof>
std::vector<int> places(const Bodies<Dof>& bodies) {
  std::vector<int> moving;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!bodies.is_fixed(i)) moving.push_back(static_cast<int>(i));
  const int axis = axis_across(moving, bodies);
  std::stable_sort(moving.begin(), moving.end(),
                   [&](int a, int b) { return bodies.x[a][axis] < bodies.x[b][axis]; });
  std::vector<int> place(bodies.size(), -1);
  for (std::size_t n = 0; n < moving.size(); ++n) place[moving[n]] = static_cast<int>(n);
  return place;
}

/// The extent of an item: the ranks of its dynamic bodies, -1 if there is none.
struct Reach {
  int low, high;
};

/// Returns the stripe of each rank, such that stripes have nearly equal numbers of items.
std::vector<int> stripes_of_places(const std::vector<Reach>& items) {
  std::vector<std::size_t> begin;  // number of items that start at each rank
  for (const Reach& item : items) {
    if (item.high >= std::ssize(begin)) begin.resize(static_cast<std::size_t>(item.high) + 1, 0);
    if (item.low >= 0) ++begin[item.low];
  }
  auto count = static_cast<std::size_t>(std::max(1.0, std::cbrt(begin.size()) / 2));
  if (count > 4)
    count -= count % 4;  // so that two threads have equal numbers of even stripes, and of odd stripes
  std::vector<int> stripe;
  std::size_t before = 0;
  for (const std::size_t here : begin) {
    stripe.push_back(static_cast<int>((before + here / 2) * count / items.size()));
    before += here;
  }
  return stripe;
}

}  // namespace

template <int Dof>
Stripes divide_into_stripes(const std::vector<std::pair<int, int>>& ends, const Bodies<Dof>& bodies,
                            int threads) {
  const std::vector<int> place = places(bodies);
  std::vector<Reach> reach(ends.size());
  parallel_for(threads, ends.size(), [&](std::size_t, std::size_t k, std::size_t end) {
    for (; k < end; ++k) {
      const auto [low, high] = std::minmax(place[ends[k].first], place[ends[k].second]);
      reach[k] = {.low = low < 0 ? high : low, .high = high};
    }
  });
  const std::vector<int> of_place = stripes_of_places(reach);
  const int rest = of_place.empty() ? 1 : of_place.back() + 1;
  const auto stripe_of = [&](const Reach& item) {
    if (item.low < 0) return 0;
    const int low = of_place[item.low], high = of_place[item.high];
    return high > low + 1 ? rest : low;
  };
  std::vector<Stripes> of_share(shares_of(threads, reach.size()));
  parallel_for(threads, reach.size(), [&](std::size_t share, std::size_t k, std::size_t end) {
    of_share[share].resize(static_cast<std::size_t>(rest) + 1);
    for (; k < end; ++k) of_share[share][stripe_of(reach[k])].push_back(static_cast<int>(k));
  });
  Stripes stripes = std::move(of_share.front());
  for (std::size_t share = 1; share < of_share.size(); ++share)
    for (std::size_t n = 0; n < stripes.size(); ++n)
      stripes[n].insert(stripes[n].end(), of_share[share][n].begin(), of_share[share][n].end());
  return stripes;
}

int threads_for(const Stripes& stripes, std::size_t items, int threads) {
  const std::size_t even = stripes.size() / 2;
  return static_cast<int>(std::clamp<std::size_t>(even, 1, shares_of(threads, items)));
}

template Stripes divide_into_stripes<3>(const std::vector<std::pair<int, int>>&, const Bodies<3>&, int);
template Stripes divide_into_stripes<6>(const std::vector<std::pair<int, int>>&, const Bodies<6>&, int);

}  // namespace spook
