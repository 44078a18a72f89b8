#pragma once
// What work costs, counted and not timed: see common/operations.hpp.
#include <cstdint>
#include <functional>
#include <string>

#include "common/operations.hpp"

namespace spook::testing {

/// The operations of another process that works for this one; graded programs have one.
inline std::uint64_t operations_elsewhere = 0;

/// Returns the operations that `work` takes in the counted files.
inline double operations_of(const std::function<void()>& work) {
  const std::uint64_t before = operations_so_far() + operations_elsewhere;
  work();
  return static_cast<double>(operations_so_far() + operations_elsewhere - before);
}

/// Expects that `large`, the operations for eight times as much, is at most `factor` times `small`; and that at least
/// `fewest` operations were counted for it, so that code which is not counted does not pass.
void expect_growth(const std::string& what, const std::string& equation, double small, double large,
                   double fewest, double factor, const std::string& why, const std::string& clue);

}  // namespace spook::testing
