#pragma once
// Random inputs until every kind of them has been seen: a corner that is drawn once in a hundred times is no test of it.
//
//   Regions regions({"free", "at lo", "at hi"});
//   while (regions.lack_draws()) {
//     ... draw ...
//     regions.draw({{"free", lo < x && x < hi}, {"at lo", x <= lo}, {"at hi", x >= hi}});
//     ... check: a failure says which kinds this draw was of, and the test ends
//   }
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace spook::testing {

class Regions {
 public:
  /// Each is to be seen so many times.
  explicit Regions(const std::vector<std::string>& names, int times = 3);

  /// Whether one more draw is wanted: not after a failure. That a region does not turn up in 100000 draws is one.
  bool lack_draws();

  /// Counts a draw, and tells failures, by given(), of which regions it is.
  void draw(const std::vector<std::pair<std::string, bool>>& is_in);

 private:
  std::map<std::string, int> seen_;
  int times_, draws_ = 0;
};

}  // namespace spook::testing
