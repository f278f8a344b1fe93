// SPDX-License-Identifier: Apache-2.0
#include "core/run_main.h"

#include <fcntl.h>
#include <pthread.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <exception>
#include <new>
#include <system_error>

#include "core/interruption.h"
#include "core/log.h"

namespace afm::core {

int fail(ExitCode code, const std::string& message) {
  log_line("error: " + message);
  return static_cast<int>(code);
}

int report_exceptions(const std::function<int()>& run) noexcept {
  try {
    return run();
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::RunFailed,
                "out of memory: use fewer samples or a smaller picture, or raise the limit (ulimit -v)");
  } catch (const std::system_error& error) {
    const bool limited = error.code() == std::errc::resource_unavailable_try_again;  // true: an error of pthread_create
    return fail(ExitCode::RunFailed,
                limited ? "cannot start another thread: raise the limits on processes and memory (ulimit -u, ulimit -v)"
                        : error.what());
  } catch (const std::exception& error) {
    return fail(ExitCode::RunFailed, error.what());
  }
}

namespace {

// Reached when a noexcept library function runs out of memory, as in toml++ 3.0, which would otherwise leave a core
// dump.
[[noreturn]] void end_in_good_order() {
  end_at_once(ExitCode::RunFailed,
              "error: out of memory or an internal fault (std::terminate): use fewer samples or a smaller picture, or "
              "raise the limit (ulimit -v)");
}

// If stdin, stdout or stderr is closed, the next opened file would get its descriptor, and the report or the log would
// go into that file. /dev/null takes its number, opened so that reading or printing still fails.
void take_standard_descriptors() {
  for (const int descriptor : {0, 1, 2}) {
    if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    // the lowest free one
    [[maybe_unused]] const int taken = ::open("/dev/null", descriptor == 0 ? O_WRONLY : O_RDONLY);
  }
}

// Raises a low limit of the stack (ulimit -s) as far as allowed, for this thread and new ones; for the latter glibc
// uses the limit at the start. Returns whether it suffices: drivers that draw need more than 1 MiB, and a program
// without stack ends by SIGSEGV, without a word.
bool has_enough_stack() {
  constexpr rlim_t kUsual = rlim_t{8} << 20U, kLeast = rlim_t{2} << 20U;
  rlimit stack{};
  if (::getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= kUsual) return true;
  const rlim_t raised = std::min(kUsual, stack.rlim_max);
  if (raised <= stack.rlim_cur) return stack.rlim_cur >= kLeast;
  stack.rlim_cur = raised;
  if (::setrlimit(RLIMIT_STACK, &stack) != 0) return false;
  pthread_attr_t attributes;
  if (::pthread_attr_init(&attributes) != 0) return false;
  ::pthread_attr_setstacksize(&attributes, raised);
  const bool set = ::pthread_setattr_default_np(&attributes) == 0;
  ::pthread_attr_destroy(&attributes);
  return set && raised >= kLeast;
}

}  // namespace

int run_main(const std::function<int()>& run) noexcept {
  take_standard_descriptors();
  std::set_terminate(end_in_good_order);
  if (!has_enough_stack()) {
    return fail(ExitCode::RunFailed, "the stack is limited to less than 2 MiB: raise the limit (ulimit -s 8192)");
  }
  return report_exceptions([&] {
    take_interruptions();
    return run();
  });
}

}  // namespace afm::core
