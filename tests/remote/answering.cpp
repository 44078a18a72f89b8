// The program with a student's function: it answers calls, and contains no tests.
//
//   descriptor 3   receives calls, sends answers: see channel.hpp
//
// A process of its own answers for each test. It is forked before the student's constants are made, so none of the
// student's code ever runs in the process that measures its time and reports its end. It may start threads, but no
// processes, so the limit of its memory is the limit of everything it does. It cannot look into other processes.
#include "answering.hpp"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/sched.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <mutex>

namespace spook::remote {

namespace {

#if defined(__x86_64__)
constexpr unsigned machine = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr unsigned machine = AUDIT_ARCH_AARCH64;
#endif

// A sender of other data than a call is not the tests.
constexpr int not_asked = 97;

[[noreturn]] void answer_until_the_end() {
  for (;;) {
    const Message call = receive();
    if (call.kind == Kind::end) break;
    if (call.kind != Kind::call) _exit(not_asked);
    Reader reader(call.bytes);
    int number = 0;
    pass(reader, number);
    const Message answer = answer_call(number, reader);
    if (!send(answer.kind, answer.bytes)) _exit(not_asked);
  }
  std::cout.flush();
  std::fflush(nullptr);
  _exit(0);
}

/// Makes the kernel refuse new processes and programs, and access to the memory and descriptors of others, by any call.
/// Kernels without filters are unchanged.
void keep_to_itself() {
#if defined(__x86_64__) || defined(__aarch64__)
  constexpr auto load = [](std::size_t offset) -> sock_filter {
    return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<unsigned>(offset));
  };
  constexpr auto result = [](unsigned value) -> sock_filter { return BPF_STMT(BPF_RET | BPF_K, value); };
  constexpr auto unless = [](unsigned value) -> sock_filter {
    return BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, 1);
  };
  sock_filter filter[] = {
      load(offsetof(seccomp_data, arch)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, machine, 1, 0),
      result(SECCOMP_RET_KILL_PROCESS),
      load(offsetof(seccomp_data, nr)),
#ifdef __x86_64__
      BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, 0x40000000, 0, 1),  // the same calls with 32-bit pointers
      result(SECCOMP_RET_KILL_PROCESS),
      unless(SYS_fork),
      result(SECCOMP_RET_ERRNO | EPERM),
      unless(SYS_vfork),
      result(SECCOMP_RET_ERRNO | EPERM),
#endif
      unless(SYS_execve),
      result(SECCOMP_RET_ERRNO | EPERM),
      unless(SYS_execveat),
      result(SECCOMP_RET_ERRNO | EPERM),
      unless(SYS_ptrace),
      result(SECCOMP_RET_ERRNO | EPERM),
      unless(SYS_process_vm_readv),
      result(SECCOMP_RET_ERRNO | EPERM),
      unless(SYS_process_vm_writev),
      result(SECCOMP_RET_ERRNO | EPERM),
      unless(SYS_pidfd_getfd),
      result(SECCOMP_RET_ERRNO | EPERM),
      unless(SYS_clone3),  // clone3, whose flags a filter cannot read: the library then calls clone
      result(SECCOMP_RET_ERRNO | ENOSYS),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_clone, 0, 3),
      load(offsetof(seccomp_data, args)),
      BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, CLONE_THREAD, 1, 0),
      result(SECCOMP_RET_ERRNO | EPERM),
      result(SECCOMP_RET_ALLOW),
  };
  const sock_fprog program{static_cast<unsigned short>(std::size(filter)), filter};
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0);
#endif
}

/// SIGKILL if a process could not be made.
Ending wait_for(pid_t process) {
  int status = SIGKILL;
  rusage used{};
  if (process > 0) wait4(process, &status, 0, &used);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return {status, seconds(used.ru_utime) + seconds(used.ru_stime)};
}

/// Returns in the answering processes, one for each test, and exits when there are no more tests.
void begin_each_test_apart() {
  prctl(PR_SET_DUMPABLE, 0);  // an answering process, which inherits this, may not look into this one
  try {
    for (;;) {
      const Message message = receive();
      if (message.kind == Kind::closed) _exit(0);
      if (message.kind != Kind::begin) continue;  // sent to a process that has ended
      send(Kind::begun);
      const pid_t process = fork();
      if (process == 0) return keep_to_itself();
      const Ending ending = wait_for(process);
      std::string bytes(sizeof ending, '\0');
      std::memcpy(bytes.data(), &ending, sizeof ending);
      send(Kind::ended, bytes);
    }
  } catch (const Nonsense&) {
    _exit(not_asked);
  }
}

// Before everything that the program does before its main.
__attribute__((constructor(101))) void begin_before_the_students_code() {
  begin_each_test_apart();
}

}  // namespace

ForceField force_of_the_tests() {
  return [](std::size_t i, const std::vector<Vec3>& x) {
    static std::mutex asking;  // of threads that ask at once each has its own answer
    const std::lock_guard one_at_a_time(asking);
    std::string bytes;
    Writer writer(bytes);
    auto positions = x;
    pass(writer, i);
    pass(writer, positions);
    send(Kind::force_at, bytes);
    const Message answer = receive();
    Reader reader(answer.bytes);
    if (answer.kind == Kind::threw) throw_again(reader);
    if (answer.kind != Kind::returned) _exit(not_asked);
    Vec3 force;
    pass(reader, force);
    return force;
  };
}

}  // namespace spook::remote

/// The replacement of a student's system("pause"), which keeps a window open on other systems.
extern "C" int spook_no_system(const char*) {
  return 0;
}

/// Replaces syscall(): std::latch and std::atomic wait by it, and all other calls are refused.
extern "C" long spook_only_futex(long number, ...) {
  if (number != SYS_futex) {
    errno = ENOSYS;
    return -1;
  }
  va_list rest;
  va_start(rest, number);
  long words[6];
  for (long& word : words) word = va_arg(rest, long);
  va_end(rest);
  return syscall(number, words[0], words[1], words[2], words[3], words[4], words[5]);
}

int main() {
  try {
    spook::remote::answer_until_the_end();
  } catch (const spook::remote::Nonsense&) {
    return spook::remote::not_asked;
  }
}
