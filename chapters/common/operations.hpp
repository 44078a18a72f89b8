#pragma once
// Counts operations, by which a test measures how the cost of a function grows. Unlike a time, a count is the same on
// every machine and under any load. chapters/CMakeLists.txt lists the counted files. The compiler adds a call to each
// of their basic blocks, the stretches of code between two branches.
#include <cstdint>

namespace spook {

/// Returns the number of basic blocks that counted files have run since the program began, in all threads.
std::uint64_t operations_so_far();

}  // namespace spook
