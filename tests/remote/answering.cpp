// The program with a student's function: it answers calls, and contains no tests.
//
//   descriptor 3   receives calls, sends answers: see channel.hpp
//
// A process of its own answers for each test. It is forked before the student's constants are made, so none of the
// student's code ever runs in the process that measures its time and reports its end. It may start threads, but no
// processes, so the limit of its memory is the limit of everything it does. It cannot look into other processes.
#include "answering.hpp"

#include <fcntl.h>
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
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <iostream>
#include <mutex>
#include <vector>

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

#if defined(__x86_64__) || defined(__aarch64__)
constexpr long refused[] = {
#ifdef __x86_64__
    // the older forms of some below
    SYS_fork, SYS_vfork, SYS_creat, SYS_mkdir, SYS_mknod, SYS_symlink, SYS_link,
#endif
    // new processes and programs, and the memory and descriptors of others
    SYS_execve, SYS_execveat, SYS_ptrace, SYS_process_vm_readv, SYS_process_vm_writev, SYS_pidfd_getfd,
    // memory that the limit of a process does not count, or that outlives it
    SYS_shmget, SYS_shmat, SYS_shmdt, SYS_shmctl, SYS_msgget, SYS_semget, SYS_mq_open, SYS_memfd_create,
    SYS_memfd_secret, SYS_add_key, SYS_request_key, SYS_keyctl,
    // new names in folders, which may be in memory, too
    SYS_mkdirat, SYS_mknodat, SYS_symlinkat, SYS_linkat, SYS_bind,
    // namespaces and file systems of its own
    SYS_unshare, SYS_setns, SYS_mount, SYS_umount2, SYS_pivot_root, SYS_chroot, SYS_open_tree, SYS_move_mount,
    SYS_fsopen, SYS_fsconfig, SYS_fsmount, SYS_fspick, SYS_mount_setattr,
    // ways around this filter, and parts of the kernel that no answer needs
    SYS_io_uring_setup, SYS_io_uring_enter, SYS_io_uring_register, SYS_bpf, SYS_userfaultfd,
    SYS_perf_event_open};
// Their flags are in memory, which a filter cannot read. The library then calls clone and openat.
constexpr long unknown[] = {SYS_clone3, SYS_openat2};
#endif

/// Makes the kernel refuse new processes and programs, access to the memory and descriptors of others, and memory that
/// is not counted, by any call. A file is opened for reading only. Kernels without filters are unchanged.
void keep_to_itself() {
#if defined(__x86_64__) || defined(__aarch64__)
  constexpr auto load = [](std::size_t offset) -> sock_filter {
    return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<unsigned>(offset));
  };
  constexpr auto result = [](unsigned value) -> sock_filter { return BPF_STMT(BPF_RET | BPF_K, value); };
  // These skip the next instructions, unless the loaded value is this one, or has one of these bits.
  constexpr auto is = [](long value, unsigned char skipped = 1) -> sock_filter {
    return BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(value), 0, skipped);
  };
  constexpr auto has = [](unsigned bits) -> sock_filter {
    return BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, bits, 0, 1);
  };
  constexpr unsigned allow = SECCOMP_RET_ALLOW, refuse = SECCOMP_RET_ERRNO | EPERM;
  std::vector<sock_filter> filter{
      load(offsetof(seccomp_data, arch)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, machine, 1, 0),
      result(SECCOMP_RET_KILL_PROCESS),
      load(offsetof(seccomp_data, nr)),
#ifdef __x86_64__
      BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, 0x40000000, 0, 1),  // the same calls with 32-bit pointers
      result(SECCOMP_RET_KILL_PROCESS),
#endif
  };
  const auto add = [&](std::initializer_list<sock_filter> more) { filter.insert(filter.end(), more); };
  const auto add_flagged = [&](long call, std::size_t argument, unsigned flags, unsigned with,
                               unsigned without) {
    add({is(call, 4), load(offsetof(seccomp_data, args) + argument * sizeof(std::uint64_t)), has(flags),
         result(with), result(without)});
  };
  for (const long call : refused) add({is(call), result(refuse)});
  for (const long call : unknown) add({is(call), result(SECCOMP_RET_ERRNO | ENOSYS)});
  add_flagged(SYS_clone, 0, CLONE_THREAD, allow, refuse);
  add_flagged(SYS_openat, 2, O_WRONLY | O_RDWR | O_CREAT, refuse, allow);
#ifdef __x86_64__
  add_flagged(SYS_open, 1, O_WRONLY | O_RDWR | O_CREAT, refuse, allow);
#endif
  add({result(allow)});
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
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
