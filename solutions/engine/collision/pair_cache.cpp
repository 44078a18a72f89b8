#include "engine/collision/pair_cache.hpp"

#include <algorithm>

#include "08_pairs/touching_bounds.hpp"

namespace spook {

namespace {

constexpr double larger_by = 0.1;        // on each side, relative to the widest of the bounds
constexpr std::size_t few_bodies = 100;  // comparing these with all others costs no more than a broad phase

Bounds enlarged_bounds(const Bounds& one) {
  const Vec3 more = Vec3::Constant(larger_by * (one.upper - one.lower).maxCoeff());
  return {.lower = one.lower - more, .upper = one.upper + more};
}

bool is_within(const Bounds& one, const Bounds& other) {
  return (other.lower.array() <= one.lower.array()).all() && (one.upper.array() <= other.upper.array()).all();
}

/// Returns the bodies that have left their enlarged bounds; all bodies if their number has changed.
std::vector<int> that_left(const std::vector<Bounds>& bounds, const std::vector<Bounds>& enlarged) {
  std::vector<int> gone;
  for (int k = 0; k < std::ssize(bounds); ++k)
    if (bounds.size() != enlarged.size() || !is_within(bounds[k], enlarged[k])) gone.push_back(k);
  return gone;
}

/// Returns the candidate pairs.
std::vector<Pair> broad_phase(const std::vector<Bounds>& bounds) {
  const int n = static_cast<int>(bounds.size());
  if (n > 32) return n <= 2000 ? sweep_and_prune(bounds) : spatial_hash(bounds);
  std::vector<Pair> pairs;
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b) pairs.emplace_back(a, b);
  return pairs;
}

}  // namespace

void PairCache::enlarge_all(const std::vector<Bounds>& bounds) {
  std::vector<Bounds> enlarged;
  enlarged.reserve(bounds.size());
  for (const Bounds& one : bounds) enlarged.push_back(enlarged_bounds(one));
  near_ = broad_phase(enlarged);
  enlarged_ = std::move(enlarged);
}

void PairCache::enlarge(const std::vector<int>& these, const std::vector<Bounds>& bounds) {
  std::vector<bool> is_new(bounds.size(), false);
  for (const int a : these) {
    is_new[a] = true;
    enlarged_[a] = enlarged_bounds(bounds[a]);
  }
  std::erase_if(near_, [&](const Pair& pair) { return is_new[pair.first] || is_new[pair.second]; });
  const auto kept = std::ssize(near_);
  for (const int a : these)
    for (int b = 0; b < std::ssize(enlarged_); ++b)
      if (touch(enlarged_[a], enlarged_[b]) && (is_new[b] ? a < b : a != b)) near_.push_back(std::minmax(a, b));
  std::sort(near_.begin() + kept, near_.end());
  std::inplace_merge(near_.begin(), near_.begin() + kept, near_.end());
}

const std::vector<Pair>& PairCache::touching(const std::vector<Bounds>& bounds) {
  const std::vector<int> gone = that_left(bounds, enlarged_);
  if (!gone.empty()) {
    require_sound(bounds);
    if (enlarged_.size() == bounds.size() && gone.size() <= few_bodies)
      enlarge(gone, bounds);
    else
      enlarge_all(bounds);
  }
  touching_.clear();
  for (const Pair& pair : near_)
    if (touch(bounds[static_cast<std::size_t>(pair.first)], bounds[static_cast<std::size_t>(pair.second)]))
      touching_.push_back(pair);
  return touching_;
}

}  // namespace spook
