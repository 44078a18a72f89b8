#include <atomic>
#include <exception>
#include <thread>

#include "14_fast_rows/fast_rows.hpp"

namespace spook {

namespace {

/// A barrier at which threads wait for all others; the last one runs the work between two rounds. A waiting thread
/// polls for a while, since sleeping and waking take longer than many rounds.
class MeetingPoint {
 public:
  MeetingPoint(int threads, const std::function<void()>& between)
      : threads_(threads), missing_(threads), between_(between) {}

  void meet() {
    const int round = round_;
    if (come()) return;
    for (int look = 1; look <= looks; ++look) {
      if (round_ != round) return;
      if (look % looks_before_others == 0) std::this_thread::yield();
    }
    round_.wait(round);
  }

  /// Removes a thread from the barrier.
  void leave() {
    --threads_;
    come();
  }

 private:
  static constexpr int looks = 100'000;             // some hundreds of microseconds
  static constexpr int looks_before_others = 1000;  // then yields the core to other threads

  /// Returns whether the caller was the last thread.
  bool come() {
    if (--missing_ > 0) return false;
    between_();
    missing_ = threads_.load();
    ++round_;
    round_.notify_all();
    return true;
  }

  std::atomic<int> threads_, missing_, round_ = 0;
  const std::function<void()>& between_;
};

}  // namespace

void in_rounds(int threads, const std::function<void(int thread)>& work, const std::function<bool()>& next) {
  if (threads == 1) {
    do work(0);
    while (next());
    return;
  }
  bool go_on = true;
  std::vector<std::exception_ptr> thrown(static_cast<std::size_t>(threads));
  const std::function<void()> between = [&] {  // on one thread, when all have arrived
    for (const std::exception_ptr& what : thrown)
      if (what) go_on = false;
    try {
      go_on = go_on && next();
    } catch (...) {
      thrown[0] = std::current_exception();
      go_on = false;
    }
  };
  MeetingPoint all_done(threads, between);
  const auto member = [&](int thread) {
    while (go_on) {
      try {
        work(thread);
      } catch (...) {
        thrown[static_cast<std::size_t>(thread)] = std::current_exception();
      }
      all_done.meet();
    }
  };
  std::vector<std::thread> others;  // many releases of libc++ have no std::jthread
  try {
    for (int thread = 1; thread < threads; ++thread) others.emplace_back(member, thread);
    member(0);
  } catch (...) {  // no more threads are available: the existing ones end after a round
    thrown[0] = std::current_exception();
    for (int missing = static_cast<int>(others.size()); missing < threads; ++missing) all_done.leave();
  }
  for (std::thread& other : others) other.join();
  for (const std::exception_ptr& what : thrown)
    if (what) std::rethrow_exception(what);
}

}  // namespace spook
