// Rounds on threads that are kept between calls. A new thread may first have to share the core of the thread that made
// it, for longer than a step takes.
#include <unistd.h>

#include <atomic>
#include <exception>
#include <memory>
#include <thread>

#include "14_fast_rows/fast_rows.hpp"

namespace spook {

namespace {

/// Waits until a number has another value. Polls for a while, since sleeping and waking take longer than many rounds.
void wait_for_change(const std::atomic<int>& number, int value) {
  constexpr int looks = 100'000;             // some hundreds of microseconds
  constexpr int looks_before_others = 1000;  // then yields the core to other threads
  for (int look = 1; look <= looks; ++look) {
    if (number != value) return;
    if (look % looks_before_others == 0) std::this_thread::yield();
  }
  number.wait(value);
}

/// A barrier at which threads wait for all others; the last one runs the work between two rounds.
class MeetingPoint {
 public:
  MeetingPoint(int threads, const std::function<void()>& between)
      : threads_(threads), missing_(threads), between_(between) {}

  void meet() {
    const int round = round_;
    if (--missing_ > 0) return wait_for_change(round_, round);
    between_();
    missing_ = threads_;
    ++round_;
    round_.notify_all();
  }

 private:
  const int threads_;
  std::atomic<int> missing_, round_ = 0;
  const std::function<void()>& between_;
};

/// A thread that runs one piece of work after another.
class Helper {
 public:
  Helper() : thread_([this] { run(); }) {}
  ~Helper() {
    work_ = nullptr;
    begin();
    thread_.join();
  }

  void start(const std::function<void()>& work) {
    work_ = &work;
    begin();
  }
  void wait() const {
    for (int ended = ended_; ended != begun_; ended = ended_) wait_for_change(ended_, ended);
  }

 private:
  void begin() {
    ++begun_;
    begun_.notify_one();
  }
  void run() {
    for (int n = 0;; ++n) {
      wait_for_change(begun_, n);
      if (!work_) return;
      (*work_)();
      ++ended_;
      ended_.notify_one();
    }
  }

  const std::function<void()>* work_ = nullptr;  // null: the thread ends
  std::atomic<int> begun_ = 0, ended_ = 0;       // numbers of pieces of work
  std::thread thread_;                           // many releases of libc++ have no std::jthread
};

/// The helpers of a thread.
class Helpers {
 public:
  Helpers() = default;
  ~Helpers() { forget_if_forked(); }

  bool are_busy() const { return busy_; }

  /// Calls member(0) on this thread, and each other member(t), t < threads, on a helper. A member must not throw.
  void run(int threads, const std::function<void(int)>& member) {
    forget_if_forked();
    while (std::ssize(helpers_) < threads - 1) helpers_.push_back(std::make_unique<Helper>());
    std::vector<std::function<void()>> work;
    for (int t = 1; t < threads; ++t) work.emplace_back([&member, t] { member(t); });
    busy_ = true;
    for (std::size_t t = 0; t < work.size(); ++t) helpers_[t]->start(work[t]);
    member(0);
    for (std::size_t t = 0; t < work.size(); ++t) helpers_[t]->wait();
    busy_ = false;
  }

 private:
  /// A fork copies the helpers without their threads, which nobody may wait for.
  void forget_if_forked() {
    if (process_ == getpid()) return;
    for (std::unique_ptr<Helper>& helper : helpers_) static_cast<void>(helper.release());
    helpers_.clear();
    busy_ = false;
    process_ = getpid();
  }

  std::vector<std::unique_ptr<Helper>> helpers_;
  bool busy_ = false;
  pid_t process_ = getpid();
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
  thread_local Helpers kept;
  if (kept.are_busy())
    Helpers().run(threads, member);
  else
    kept.run(threads, member);
  for (const std::exception_ptr& what : thrown)
    if (what) std::rethrow_exception(what);
}

}  // namespace spook
