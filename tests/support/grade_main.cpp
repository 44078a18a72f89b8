// The main of a graded program: runs one test and hands its verdict to the grader over a private descriptor.
//
//   grade_01_leapfrog Kick.AddsForceOverMass     with the nonce on descriptor 3, the verdict on descriptor 4
//   grade_01_leapfrog --list                     every test, a line each
//
// The student's code runs in this process, so nothing that it prints, writes or returns counts. What counts is a verdict
// between two copies of a nonce that is read, and its descriptor closed, before any of the student's initialisers run,
// followed at once by _exit: no destructor and no atexit handler comes after it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

namespace {

constexpr int nonce_descriptor = 3;
constexpr int verdict_descriptor = 4;
constexpr std::size_t nonce_size = 32;

// Plain arrays: they are filled before constructors of the library's types have run.
std::array<char, nonce_size> nonce;
std::array<char, 32> seed;

// Priority 101 is the first that is not reserved; the grader refuses an object that asks for a priority at all.
__attribute__((constructor(101))) void take_nonce() {
  std::size_t count = 0;
  while (count < nonce_size) {
    const ssize_t more = read(nonce_descriptor, nonce.data() + count, nonce_size - count);
    if (more <= 0) break;
    count += static_cast<std::size_t>(more);
  }
  close(nonce_descriptor);
  if (const char* given = std::getenv("SPOOK_SEED")) std::strncpy(seed.data(), given, seed.size() - 1);
}

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

void write_all(std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = write(verdict_descriptor, text.data(), text.size());
    if (count <= 0) _exit(3);
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

/// Fields that end with a NUL: nonce, GoogleTest's own verdict, tests that ran, whether one was skipped, each failure,
/// nonce.
std::string verdict(int result, const Recorder& recorder) {
  const std::string_view secret(nonce.data(), nonce.size());
  std::string text;
  const auto add = [&text](std::string_view field) { text.append(field).push_back('\0'); };
  add(secret);
  add(std::to_string(result));
  add(std::to_string(recorder.ran));
  add(recorder.skipped ? "skipped" : "");
  for (const std::string& failure : recorder.failures) add(failure);
  add(secret);
  return text;
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

}  // namespace

int main(int argc, char** argv) {
  const std::string test = argc == 2 ? argv[1] : "";
  if (test.empty()) {
    std::cerr << "usage: " << argv[0] << " SUITE.TEST | --list\n";
    return 2;
  }
  // What an initialiser has put into the environment steers neither GoogleTest nor the random inputs.
  clearenv();
  if (seed[0] != '\0') setenv("SPOOK_SEED", seed.data(), 1);
  std::string filter = "--gtest_filter=" + test;
  std::vector<char*> words{argv[0], filter.data(), nullptr};
  int count = 2;
  testing::InitGoogleTest(&count, words.data());
  if (test == "--list") return list_tests();

  testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
  delete listeners.Release(listeners.default_result_printer());  // what is printed is the student's alone
  auto* recorder = new Recorder;
  listeners.Append(recorder);
  const int result = RUN_ALL_TESTS();
  std::cout.flush();
  std::fflush(nullptr);
  write_all(verdict(result, *recorder));
  _exit(0);
}
