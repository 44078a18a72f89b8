#pragma once
// Counts operations, so that a test can say how the cost of a function grows. A count is the same on every machine and
// under any load, which a time is not. The files that are counted are named in chapters/CMakeLists.txt; the compiler puts
// a call into each of their basic blocks, the stretches of code between two branches.
#include <cstdint>

namespace spook {

/// Returns the number of basic blocks that counted files have run since the program began, in all threads.
std::uint64_t operations_so_far();

}  // namespace spook
