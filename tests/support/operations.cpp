#include "operations.hpp"

#include "checks.hpp"

namespace spook::testing {

void expect_growth(const std::string& what, const std::string& equation, double small, double large,
                   double fewest, double factor, const std::string& why, const std::string& clue) {
  const std::string counted =
      "an operation is a stretch of code between two branches; they are counted, not timed";
  expect_at_least("operations for " + what, equation, large, fewest, "one for each item or so; " + counted,
                  "Almost no operation of this function was counted. Is its work done by code that is not "
                  "compiled with it?");
  expect_at_most("operations for " + what + ", divided by those for an eighth as many", equation, large / small,
                 factor, why + "; " + counted, clue);
}

}  // namespace spook::testing
