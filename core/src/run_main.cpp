// SPDX-License-Identifier: Apache-2.0
#include "core/run_main.h"

#include <fcntl.h>

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

}  // namespace

int run_main(const std::function<int()>& run) noexcept {
  take_standard_descriptors();
  std::set_terminate(end_in_good_order);
  return report_exceptions([&] {
    take_interruptions();
    return run();
  });
}

}  // namespace afm::core
