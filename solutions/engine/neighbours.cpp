#include "engine/neighbours.hpp"

#include "08_pairs/touching_bounds.hpp"

namespace spook {

namespace {

constexpr double room = 0.1;  // on each side, over the widest of the bounds

Bounds roomier(const Bounds& one) {
  const Vec3 more = Vec3::Constant(room * (one.upper - one.lower).maxCoeff());
  return {.lower = one.lower - more, .upper = one.upper + more};
}

bool is_within(const Bounds& one, const Bounds& other) {
  return (other.lower.array() <= one.lower.array()).all() && (one.upper.array() <= other.upper.array()).all();
}

/// The pairs that are worth a closer look.
std::vector<Pair> broad_phase(const std::vector<Bounds>& bounds) {
  const int n = static_cast<int>(bounds.size());
  if (n > 32) return n <= 2000 ? sweep_and_prune(bounds) : spatial_hash(bounds);
  std::vector<Pair> pairs;
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b) pairs.emplace_back(a, b);
  return pairs;
}

}  // namespace

bool Neighbours::still_hold(const std::vector<Bounds>& bounds) const {
  return std::equal(bounds.begin(), bounds.end(), roomy_.begin(), roomy_.end(), is_within);
}

const std::vector<Pair>& Neighbours::touching(const std::vector<Bounds>& bounds) {
  if (!still_hold(bounds)) {
    require_sound(bounds);
    std::vector<Bounds> roomy;
    for (const Bounds& one : bounds) roomy.push_back(roomier(one));
    near_ = broad_phase(roomy);
    roomy_ = std::move(roomy);
  }
  touching_.clear();
  for (const Pair& pair : near_)
    if (touch(bounds[static_cast<std::size_t>(pair.first)], bounds[static_cast<std::size_t>(pair.second)]))
      touching_.push_back(pair);
  return touching_;
}

}  // namespace spook
