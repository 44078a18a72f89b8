#pragma once
// Reports the pairs of bodies that began or ceased to touch in a step. It costs nothing unless requested.
#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "engine/world/world.hpp"

namespace spook {

/// Two bodies, i < j.
using TouchingPair = std::pair<int, int>;

/// Bodies touch in a step if one of their contacts has a gap of at most 0 or an impulse, or if they collided. So a
/// bounce begins in its step, and ends in the next step. If the engine divides a step, World::parts(), the contacts are
/// those of its last part.
class ContactEvents {
 public:
  /// Compares the world's last step with the one that was looked at before. Call it after each step.
  template <int Dof>
  void look(const World<Dof>& world) {
    std::vector<TouchingPair> now;
    for (int c = 0; c < static_cast<int>(world.contacts().size()); ++c) {
      const Contact& contact = world.contacts()[static_cast<std::size_t>(c)];
      if (contact.gap <= 0 || world.lambda(c) > 0) now.push_back(std::minmax(contact.i, contact.j));
    }
    for (const Impact& impact : world.impacts()) now.push_back(std::minmax(impact.i, impact.j));
    std::sort(now.begin(), now.end());
    now.erase(std::unique(now.begin(), now.end()), now.end());
    begun_ = difference(now, touching_);
    ended_ = difference(touching_, now);
    touching_ = std::move(now);
  }

  /// Drops the pairs of a removed body, and gives those of later bodies their new indices. Call it after
  /// World::remove_body.
  void remove_body(int body) {
    for (std::vector<TouchingPair>* pairs : {&touching_, &begun_, &ended_}) {
      std::erase_if(*pairs,
                    [&](const TouchingPair& pair) { return pair.first == body || pair.second == body; });
      for (auto& [i, j] : *pairs) {
        i -= i > body;
        j -= j > body;
      }
    }
  }

  /// Forgets all pairs: for a world that was replaced by another one.
  void forget() { touching_.clear(), begun_.clear(), ended_.clear(); }

  /// Pairs that touched in the last step and not in the one before, in ascending order.
  const std::vector<TouchingPair>& begun() const { return begun_; }
  /// Pairs that touched in the step before the last and not in the last.
  const std::vector<TouchingPair>& ended() const { return ended_; }
  /// Pairs that touched in the last step.
  const std::vector<TouchingPair>& touching() const { return touching_; }

 private:
  static std::vector<TouchingPair> difference(const std::vector<TouchingPair>& of,
                                              const std::vector<TouchingPair>& less) {
    std::vector<TouchingPair> left;
    std::set_difference(of.begin(), of.end(), less.begin(), less.end(), std::back_inserter(left));
    return left;
  }

  std::vector<TouchingPair> touching_, begun_, ended_;
};

}  // namespace spook
