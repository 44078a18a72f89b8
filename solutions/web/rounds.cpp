// Chapter 14's rounds where there is one thread alone: its shares one after the other. A round's shares have nothing to
// do with each other, so that the numbers are those of threads.
#include "14_fast_rows/fast_rows.hpp"

namespace spook {

void in_rounds(int threads, const std::function<void(int thread)>& work, const std::function<bool()>& next) {
  do {
    for (int thread = 0; thread < threads; ++thread) work(thread);
  } while (next());
}

}  // namespace spook
