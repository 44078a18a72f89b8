#pragma once
// Bodies that do not touch each other: lists of bodies, no two of which have a contact. A world without lists pays
// nothing for them.
#include <algorithm>
#include <vector>

namespace spook {

class Exclusions {
 public:
  /// Adds a list: no two of these bodies touch.
  void add(const std::vector<int>& bodies) { lists_.push_back(bodies), arrange(); }

  /// Tells whether a list has both bodies.
  bool excludes(int i, int j) const {
    if (std::max(i, j) >= static_cast<int>(lists_of_.size())) return false;
    const std::vector<std::size_t>& of_i = lists_of_[static_cast<std::size_t>(i)];
    const std::vector<std::size_t>& of_j = lists_of_[static_cast<std::size_t>(j)];
    return std::find_first_of(of_i.begin(), of_i.end(), of_j.begin(), of_j.end()) != of_i.end();
  }

  /// Removes a body. The indices of later bodies decrease by one.
  void remove(int body) {
    for (std::vector<int>& list : lists_) {
      std::erase(list, body);
      for (int& other : list) other -= other > body;
    }
    arrange();
  }

  const std::vector<std::vector<int>>& lists() const { return lists_; }

 private:
  void arrange() {
    lists_of_.clear();
    for (std::size_t list = 0; list < lists_.size(); ++list)
      for (const int body : lists_[list]) {
        const auto b = static_cast<std::size_t>(body);
        if (b >= lists_of_.size()) lists_of_.resize(b + 1);
        lists_of_[b].push_back(list);
      }
  }

  std::vector<std::vector<int>> lists_;             // the bodies of each list
  std::vector<std::vector<std::size_t>> lists_of_;  // the lists of each body
};

}  // namespace spook
