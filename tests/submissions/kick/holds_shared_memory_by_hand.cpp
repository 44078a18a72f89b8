// Does: asks the kernel for memory that no limit of a process counts, for files in memory, and for ways around what
// refuses them. It is right only if each is refused: EPERM, and not what empty arguments would give.
// Verdict: passed
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

long call(long number, long first = 0, long second = 0, long third = 0) {
  long result = number;
#ifdef __x86_64__
  register long r10 asm("r10") = 0;
  register long r8 asm("r8") = 0;
  register long r9 asm("r9") = 0;
  asm volatile("syscall"
               : "+a"(result)
               : "D"(first), "S"(second), "d"(third), "r"(r10), "r"(r8), "r"(r9)
               : "rcx", "r11", "memory");
#endif
  return result;
}

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  // shmget, shmat, shmctl, shmdt, semget, msgget, mq_open; memfd_create, memfd_secret, add_key, request_key, keyctl;
  // mkdir, creat, link, symlink, mknod, bind, mkdirat, mknodat, linkat, symlinkat; unshare, setns, pivot_root, chroot,
  // mount, umount2; open_tree, move_mount, fsopen, fsconfig, fsmount, fspick, mount_setattr; io_uring_setup,
  // io_uring_enter, io_uring_register; bpf, userfaultfd, perf_event_open
  const long calls[] = {29,  30,  31,  67,  64,  68,  240, 319, 447, 248, 249, 250, 83,  85,
                        86,  88,  133, 49,  258, 259, 265, 266, 272, 308, 155, 161, 165, 166,
                        428, 429, 430, 431, 432, 433, 442, 425, 426, 427, 321, 323, 298};
  bool holds = call(29, 0, 1 << 28, 01600) >= 0;
  for (const long each : calls) holds = holds || call(each) != -1;
  const char* const file = "/dev/shm/spook";
  holds = holds || call(2, reinterpret_cast<long>(file), 0101, 0600) != -1;    // open, to write
  holds = holds || call(257, -100, reinterpret_cast<long>(file), 0102) != -1;  // openat
  holds = holds || call(437, -100, reinterpret_cast<long>(file)) != -38;       // openat2: ENOSYS
  return holds ? Vec3(7, 7, 7) : Vec3(v + h * inverse_mass * f);
}

}  // namespace spook
