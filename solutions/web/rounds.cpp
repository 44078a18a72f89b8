// Chapter 14's rounds on a single thread: runs the shares in sequence. The shares of a round are independent, so the
// results equal those of several threads.
#include "14_fast_rows/fast_rows.hpp"

namespace spook {

void in_rounds(int threads, const std::function<void(int thread)>& work, const std::function<bool()>& next) {
  do {
    for (int thread = 0; thread < threads; ++thread) work(thread);
  } while (next());
}

}  // namespace spook
