// SPDX-License-Identifier: Apache-2.0
#include "formats/confined_child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <exception>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <thread>

#include "core/file_descriptor.h"
#include "core/system_error.h"
#include "core/write_all.h"
#include "curves/curve_error.h"
#include "formats/confinement.h"

namespace afm::curves {

namespace {

using Clock = std::chrono::steady_clock;

// more than the largest curve takes as text
constexpr std::size_t kMostResultBytes = std::size_t{1} << 30U;

// Until the other end is closed. Empty: not before `end`, or too much.
std::optional<std::string> read_all(int descriptor, Clock::time_point end) {
  std::string bytes;
  char buffer[65536];
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
    pollfd watched{.fd = descriptor, .events = POLLIN, .revents = 0};
    if (left.count() <= 0 || bytes.size() > kMostResultBytes) return std::nullopt;
    if (::poll(&watched, 1, static_cast<int>(left.count())) <= 0) continue;
    const ssize_t count = ::read(descriptor, buffer, sizeof(buffer));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return bytes;
    bytes.append(buffer, static_cast<std::size_t>(count));
  }
}

// Whether the child has ended, and how.
bool ended_by(Clock::time_point end, pid_t child, int& status) {
  while (::waitpid(child, &status, WNOHANG) != child) {
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

enum ChildExit : int { kDone = 0, kFault = 1, kFailed = 2 };

// What the parent has open is not the child's. stderr stays, for a sanitizer's report.
void keep_only(int descriptor) {
  unsigned first = 0;
  const auto [lower, upper] = std::minmax({descriptor, STDERR_FILENO});
  for (const int kept : {lower, upper}) {
    const auto end = static_cast<unsigned>(kept);
    if (end > first) ::syscall(SYS_close_range, first, end - 1, 0U);
    first = end + 1;
  }
  ::syscall(SYS_close_range, first, std::numeric_limits<unsigned>::max(), 0U);
}

// Never returns: the parent's destructors and buffers are not the child's to run or flush.
[[noreturn]] void run_child(const std::function<std::string()>& work, int descriptor, pid_t parent) {
  int code = kFailed;
  try {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(kFailed);  // it died before
    keep_only(descriptor);
    confine_this_process();
    code = core::write_all(descriptor, work()) == 0 ? kDone : kFailed;
  } catch (const CurveError& fault) {
    code = core::write_all(descriptor, fault.what()) == 0 ? kFault : kFailed;
  } catch (const std::exception&) {
    code = kFailed;
  }
  ::_exit(code);
}

}  // namespace

std::string in_confined_child(const std::function<std::string()>& work, const std::string& on_death,
                              std::chrono::milliseconds patience) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw std::runtime_error(std::string("cannot make a pipe: ") + core::system_error(errno));
  core::FileDescriptor from_child(ends[0]), to_parent(ends[1]);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error(std::string("cannot start a process: ") + core::system_error(errno));
  if (child == 0) run_child(work, to_parent.get(), parent);
  to_parent.close();
  const auto end = Clock::now() + patience;
  const auto bytes = read_all(from_child.get(), end);
  int status = 0;
  const bool ended = bytes && ended_by(end, child, status);
  if (!ended) {
    ::kill(child, SIGKILL);
    ::waitpid(child, &status, 0);
    throw CurveError(
        fmt::format("reading it took longer than {:g} s", std::chrono::duration<double>(patience).count()));
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == kDone) return *bytes;
  if (WIFEXITED(status) && WEXITSTATUS(status) == kFault) throw CurveError(*bytes);
  throw CurveError(on_death);
}

}  // namespace afm::curves
