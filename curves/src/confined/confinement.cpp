// SPDX-License-Identifier: Apache-2.0
#include "confined/confinement.h"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/file_descriptor.h"
#include "core/system_error.h"

namespace afm::curves {

namespace {

constexpr rlim_t kMoreMemory = rlim_t{512} << 20U;

// Calls for memory, time, waiting threads, open descriptors, and exit. A pipe within the process is harmless; UBSan
// uses one to test whether an address is readable.
constexpr std::array kAllowedCalls{
    __NR_read,         __NR_write,          __NR_readv,        __NR_writev,        __NR_pread64,
    __NR_lseek,        __NR_close,          __NR_fstat,        __NR_newfstatat,    __NR_mmap,
    __NR_munmap,       __NR_mremap,         __NR_mprotect,     __NR_madvise,       __NR_brk,
    __NR_futex,        __NR_sched_yield,    __NR_nanosleep,    __NR_clock_gettime, __NR_clock_nanosleep,
    __NR_gettimeofday, __NR_getpid,         __NR_gettid,       __NR_getrusage,     __NR_getrandom,
    __NR_rt_sigaction, __NR_rt_sigprocmask, __NR_rt_sigreturn, __NR_sigaltstack,   __NR_restart_syscall,
    __NR_pipe2,
#ifdef __NR_pipe
    __NR_pipe,
#endif
    __NR_exit,         __NR_exit_group};

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
#error "add this processor's AUDIT_ARCH_ constant"
#endif

[[noreturn]] void refuse(const char* what) {
  throw std::runtime_error(std::string("cannot confine the reader of a file: ") + what + ": " +
                           core::system_error(errno));
}

// A lower limit, as by ulimit, stays: only root may raise it.
bool lower_limit(__rlimit_resource_t resource, rlim_t most) {
  rlimit now{};
  if (::getrlimit(resource, &now) != 0) return false;
  const rlimit lowered{std::min(most, now.rlim_cur), std::min(most, now.rlim_max)};
  return ::setrlimit(resource, &lowered) == 0;
}

void limit_resources(std::chrono::seconds processor_time) {
  // in pages; relative, because a sanitizer has mapped terabytes already
  rlim_t mapped = 0;
  std::ifstream("/proc/self/statm") >> mapped;
  const rlim_t memory = mapped * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + kMoreMemory;
  const rlimit no_core{0, 0};
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const rlim_t seconds = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec + processor_time.count());
  if (!lower_limit(RLIMIT_AS, memory) || !lower_limit(RLIMIT_CPU, seconds) || ::setrlimit(RLIMIT_CORE, &no_core) != 0) {
    refuse("setrlimit");
  }
}

// Handles every right of Landlock's first version and grants none (Linux, Documentation/userspace-api/landlock.rst).
void close_files() {
  landlock_ruleset_attr none{};
  none.handled_access_fs = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1U) - 1U;
  const core::FileDescriptor rules(
      static_cast<int>(::syscall(SYS_landlock_create_ruleset, &none, sizeof(none.handled_access_fs), 0)));
  if (!rules.is_open()) {
    if (errno == ENOSYS || errno == EOPNOTSUPP) return;
    refuse("landlock_create_ruleset");
  }
  if (::syscall(SYS_landlock_restrict_self, rules.get(), 0) != 0) refuse("landlock_restrict_self");
}

// Any other call fails with EPERM, so that libraries can report an error, which a signal would prevent (Linux,
// Documentation/userspace-api/seccomp_filter.rst).
void close_calls() {
  std::vector<sock_filter> filter{
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
  };
  for (const auto call : kAllowedCalls) {
    filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 1));
    filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  }
  filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM));
  sock_fprog program{.len = static_cast<unsigned short>(filter.size()), .filter = filter.data()};
  if (::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0 && errno != EINVAL && errno != ENOSYS) {
    refuse("seccomp");
  }
}

}  // namespace

void confine_this_process(std::chrono::seconds processor_time) {
  limit_resources(processor_time);
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) refuse("no_new_privs");
  close_files();
  close_calls();
}

}  // namespace afm::curves
