#pragma once
// The cost of work as a number of operations, not as a time: see common/operations.hpp.
#include <cstdint>
#include <functional>
#include <string>

#include "common/operations.hpp"

namespace spook::testing {

/// The operations of another process, which runs a graded program for this one.
inline std::uint64_t operations_elsewhere = 0;

/// Returns the number of operations of `work` in the counted files.
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
