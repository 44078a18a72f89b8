#pragma once
// Draws random inputs until each kind of input has occurred often enough. A rare kind would not be tested otherwise.
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
  /// Requires each region to occur so many times.
  explicit Regions(const std::vector<std::string>& names, int times = 3);

  /// Tells whether another draw is needed; false after a failure. It is a failure if a region does not occur in 100000
  /// draws.
  bool lack_draws();

  /// Counts a draw, and adds its regions to failure messages by given().
  void draw(const std::vector<std::pair<std::string, bool>>& is_in);

 private:
  std::map<std::string, int> seen_;
  int times_, draws_ = 0;
};

}  // namespace spook::testing
