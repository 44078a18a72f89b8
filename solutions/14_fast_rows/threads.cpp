#include <barrier>
#include <exception>
#include <thread>

#include "14_fast_rows/fast_rows.hpp"

namespace spook {

void in_rounds(int threads, const std::function<void(int thread)>& work, const std::function<bool()>& next) {
  if (threads == 1) {
    do work(0);
    while (next());
    return;
  }
  bool go_on = true;
  std::vector<std::exception_ptr> thrown(static_cast<std::size_t>(threads));
  const auto between = [&]() noexcept {  // alone, when all have come
    for (const std::exception_ptr& what : thrown)
      if (what) go_on = false;
    try {
      go_on = go_on && next();
    } catch (...) {
      thrown[0] = std::current_exception();
      go_on = false;
    }
  };
  std::barrier all_done(threads, between);
  const auto member = [&](int thread) {
    while (go_on) {
      try {
        work(thread);
      } catch (...) {
        thrown[static_cast<std::size_t>(thread)] = std::current_exception();
      }
      all_done.arrive_and_wait();
    }
  };
  std::vector<std::jthread> others;
  try {
    for (int thread = 1; thread < threads; ++thread) others.emplace_back(member, thread);
    member(0);
  } catch (...) {  // no more threads are to be had: those that are there go home after a round
    thrown[0] = std::current_exception();
    for (int missing = static_cast<int>(others.size()); missing < threads; ++missing)
      all_done.arrive_and_drop();
  }
  others.clear();  // waits for them
  for (const std::exception_ptr& what : thrown)
    if (what) std::rethrow_exception(what);
}

}  // namespace spook
