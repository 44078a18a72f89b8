#include "operations.hpp"

#include "checks.hpp"

namespace spook::testing {

void expect_growth(const std::string& what, const std::string& equation, double small, double large,
                   double fewest, double factor, const std::string& why, const std::string& clue) {
  expect_at_least(
      "operations for " + what, equation, large, fewest,
      "an operation is a stretch of code between two branches, and each item takes some",
      "Nearly nothing of this function was counted. Is its work done by code that is not compiled with it?");
  expect_at_most("operations for " + what + ", over those for an eighth of it", equation, large / small, factor,
                 why, clue);
}

}  // namespace spook::testing
