#include "common/operations.hpp"

#include <atomic>

static std::atomic<std::uint64_t> operations{0};

std::uint64_t spook::operations_so_far() {
  return operations.load(std::memory_order_relaxed);
}

/// Counts one. Code that is compiled with -fsanitize-coverage=trace-pc calls it in each basic block.
extern "C" void __sanitizer_cov_trace_pc();
extern "C" void __sanitizer_cov_trace_pc() {
  operations.fetch_add(1, std::memory_order_relaxed);
}
