// The main of the tests when they grade. The student's function is in another process without tests, and can only
// answer.
//
//   grade_01_leapfrog --list       every test, a line each
//   grade_01_leapfrog --idle kick  the tests of its input that an empty function passes
//   grade_01_leapfrog kick         runs the tests of its input, a line each; reports on descriptor 4
//
// Calls of the named exercise go over descriptor 3. Each test has a process of its own, on both sides.
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "asking.hpp"
#include "report.hpp"

namespace {

using namespace spook::remote;

class Recorder : public testing::EmptyTestEventListener {
 public:
  int ran = 0;
  bool skipped = false;
  std::vector<std::string> failures;

 private:
  void OnTestPartResult(const testing::TestPartResult& result) override {
    skipped = skipped || result.skipped();
    if (result.failed()) failures.emplace_back(result.message());
  }

  void OnTestEnd(const testing::TestInfo&) override { ++ran; }
};

void report_verdict(int result, const Recorder& recorder) {
  std::vector<std::string> fields{"verdict", std::to_string(result), std::to_string(recorder.ran),
                                  recorder.skipped ? "skipped" : ""};
  fields.insert(fields.end(), recorder.failures.begin(), recorder.failures.end());
  report(fields);
}

void start_googletest(char* program, const std::string& test) {
  std::string filter = "--gtest_filter=" + test;
  std::vector<char*> words{program, filter.data(), nullptr};
  int count = 2;
  testing::InitGoogleTest(&count, words.data());
}

int list_tests() {
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int j = 0; j < suite.total_test_count(); ++j)
      std::cout << suite.name() << '.' << suite.GetTestInfo(j)->name() << '\n';
  }
  return 0;
}

[[noreturn]] void run(char* program, const std::string& test) {
  start_googletest(program, test);
  testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
  delete listeners.Release(listeners.default_result_printer());
  auto* recorder = new Recorder;
  listeners.Append(recorder);
  const int result = RUN_ALL_TESTS();
  report_verdict(result, *recorder);
  if (something_has_arrived()) take_what_has_arrived();
  _exit(0);
}

/// Ends the student's side, and reports on it, unless the test has done so. After a test has ended, no further answer
/// is expected.
void end_partner(bool at_its_end) {
  send(Kind::end);
  for (;;) {
    const Message message = receive();
    if (message.kind == Kind::closed) return;
    if (message.kind != Kind::ended) {
      if (at_its_end) report({"nonsense"});
      continue;
    }
    Ending ending{};
    if (message.bytes.size() != sizeof ending) throw Nonsense{};
    std::memcpy(&ending, message.bytes.data(), sizeof ending);
    report_ending(ending);
    return;
  }
}

void run_apart(char* program, const std::string& test) {
  send(Kind::begin);
  int status = 0;
  Message message = receive();
  while (message.kind != Kind::begun && message.kind != Kind::closed)
    message = receive();  // the rest of an earlier test
  if (message.kind == Kind::begun) {
    const pid_t process = fork();
    if (process == 0) run(program, test);
    if (process < 0 || waitpid(process, &status, 0) < 0) _exit(3);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
    if (code != partner_has_ended && code != stream_is_lost) end_partner(code == 0);
    if (code == stream_is_lost) {
      report({"done", "0"});
      _exit(0);
    }
  }
  report({"done", std::to_string(status)});
}

/// The callers of this exercise's functions jump to code that sends the arguments away, or to an empty function.
bool choose(std::string_view exercise, bool idle) {
  bool found = false;
  for (int k = 0; k < graded_count; ++k) {
    if (graded_functions[k].exercise != exercise) continue;
    *graded_functions[k].slot = idle ? graded_functions[k].idle : graded_functions[k].asked;
    found = true;
  }
  return found;
}

int list_passing(char* program) {
  for (std::string test; std::getline(std::cin, test);) {
    const pid_t process = fork();
    if (process == 0) {
      const rlimit seconds{10, 11};
      setrlimit(RLIMIT_CPU, &seconds);
      start_googletest(program, test);
      testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
      delete listeners.Release(listeners.default_result_printer());
      _exit(RUN_ALL_TESTS());
    }
    int status = 1;
    if (process > 0 && waitpid(process, &status, 0) == process && status == 0) std::cout << test << std::endl;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const bool idle = argc == 3 && std::string_view(argv[1]) == "--idle";
  const std::string word = argc == 2 || idle ? argv[argc - 1] : "";
  if (word == "--list") {
    start_googletest(argv[0], "*");
    return list_tests();
  }
  if (!choose(word, idle)) {
    std::cerr << "usage: " << argv[0] << " [--idle] EXERCISE | --list\n";
    return 2;
  }
  if (idle) return list_passing(argv[0]);
  prctl(PR_SET_DUMPABLE, 0);  // no other process of this user may read it
  try {
    for (std::string test; std::getline(std::cin, test);) run_apart(argv[0], test);
  } catch (const Nonsense&) {
    report({"nonsense"});
    report({"done", "0"});
  }
}
