// Writes a trace when a student's program crashes, if SPOOK_CRASH_TRACE names a file. The trace has the addresses of
// the calls that led to the crash, a line each, the innermost first. tools/course/crash.py finds the student's line by
// them.
#include <execinfo.h>
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <cstdlib>

// The linker's name of the program's start. Addresses are counted from here, wherever the program was loaded.
#ifdef __APPLE__
extern "C" const char _mh_execute_header;
static const char& program_start = _mh_execute_header;
#else
extern "C" const char __executable_start;
static const char& program_start = __executable_start;
#endif

namespace {

constexpr std::array crashes = {SIGABRT, SIGSEGV, SIGFPE, SIGILL, SIGBUS, SIGTRAP};
constexpr int most_calls = 64;

const char* file = nullptr;
std::array<char, 1 << 16> stack;  // a function that calls itself without end leaves none of the ordinary one

/// Writes the distance from the program's start in hexadecimal, and a new line. After a crash no stream is safe, nor is
/// printf.
void write_line(int descriptor, std::uintptr_t distance) {
  std::array<char, 2 * sizeof distance + 1> line;
  auto* end = line.end();
  *--end = '\n';
  do *--end = "0123456789abcdef"[distance % 16];
  while ((distance /= 16) > 0);
  if (write(descriptor, end, static_cast<std::size_t>(line.end() - end)) < 0) _exit(3);
}

void tell(int number) {
  std::array<void*, most_calls> calls;
  const int count = backtrace(calls.data(), most_calls);
  const int descriptor = open(file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  // The first two are this function and its caller. The third is the place of the signal. All others are the places
  // that calls return to, which may be the line after; the byte before belongs to the call.
  for (int k = 2; descriptor >= 0 && k < count; ++k)
    write_line(descriptor, reinterpret_cast<std::uintptr_t>(calls[static_cast<std::size_t>(k)]) -
                               reinterpret_cast<std::uintptr_t>(&program_start) - (k > 2));
  std::raise(number);  // now with its usual end
}

__attribute__((constructor)) void listen() {
  file = std::getenv("SPOOK_CRASH_TRACE");
  if (!file) return;
  std::array<void*, 1> call;
  backtrace(call.data(), 1);  // the first time it loads a library, which a crash is no place for
  stack_t elsewhere{};        // its members' order differs between systems
  elsewhere.ss_sp = stack.data();
  elsewhere.ss_size = stack.size();
  sigaltstack(&elsewhere, nullptr);
  struct sigaction action {};
  action.sa_handler = tell;
  action.sa_flags = SA_ONSTACK | SA_RESETHAND;
  for (const int number : crashes) sigaction(number, &action, nullptr);
}

}  // namespace
