// SPDX-License-Identifier: Apache-2.0
#include "formats/confined_child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <exception>
#include <filesystem>
#include <initializer_list>
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

// more than the text of the largest curve
constexpr std::size_t kMostResultBytes = std::size_t{1} << 30U;

// Reads until the other end is closed. Empty if that does not happen before `end`, or the data are too long.
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

// Waits for the child's end until `end`; returns whether it ended, and its status.
bool ended_by(Clock::time_point end, pid_t child, int& status) {
  while (::waitpid(child, &status, WNOHANG) != child) {
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

// Closes all inherited descriptors except these and stderr, which a sanitizer needs for its report.
void keep_only(std::initializer_list<int> descriptors) {
  unsigned first = 0;
  for (const int kept : descriptors) {
    const auto end = static_cast<unsigned>(kept);
    if (end > first) ::syscall(SYS_close_range, first, end - 1, 0U);
    first = end + 1;
  }
  ::syscall(SYS_close_range, first, std::numeric_limits<unsigned>::max(), 0U);
}

ChildExit work_confined(const std::function<std::string()>& work, int to_parent) {
  try {
    const auto [lower, upper] = std::minmax({to_parent, STDERR_FILENO});
    keep_only({lower, upper});
    confine_this_process();
    return core::write_all(to_parent, work()) == 0 ? ChildExit::Done : ChildExit::Failed;
  } catch (const CurveError& fault) {
    return core::write_all(to_parent, fault.what()) == 0 ? ChildExit::Fault : ChildExit::Failed;
  } catch (const std::exception&) {
    return ChildExit::Failed;
  }
}

// Forks a process that runs `child_work`, and returns what it writes to the given descriptor. The child neither runs
// the parent's destructors nor flushes its buffers.
std::string result_of(const std::function<ChildExit(int to_parent)>& child_work, const std::string& on_death,
                      std::chrono::milliseconds patience) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw std::runtime_error(std::string("cannot make a pipe: ") + core::system_error(errno));
  core::FileDescriptor from_child(ends[0]), to_parent(ends[1]);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error(std::string("cannot start a process: ") + core::system_error(errno));
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const bool orphan = ::getppid() != parent;  // the parent died earlier
    ::_exit(static_cast<int>(orphan ? ChildExit::Failed : child_work(to_parent.get())));
  }
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
  if (WIFEXITED(status) && WEXITSTATUS(status) == static_cast<int>(ChildExit::Done)) return *bytes;
  if (WIFEXITED(status) && WEXITSTATUS(status) == static_cast<int>(ChildExit::Fault)) throw CurveError(*bytes);
  throw CurveError(on_death);
}

// Path of the program with that name.
std::string find_program(const std::string& name) {
  std::error_code error;
  const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  for (const std::filesystem::path& folder : {here, here.parent_path() / "bin"}) {
    if (::access((folder / name).c_str(), X_OK) == 0) return folder / name;
  }
  throw std::runtime_error(fmt::format("{} is missing beside touchafm: build it, or install TouchAFM again", name));
}

// An anonymous file with these bytes, positioned at its beginning.
core::FileDescriptor unnamed_file(std::string_view bytes) {
  core::FileDescriptor file(::memfd_create("touchafm-curve", MFD_CLOEXEC));
  const int error = !file.is_open() ? errno : core::write_all(file.get(), bytes);
  if (error != 0 || ::lseek(file.get(), 0, SEEK_SET) != 0) {
    throw std::runtime_error(fmt::format("cannot hand a curve over: {}", core::system_error(error)));
  }
  return file;
}

}  // namespace

std::string in_confined_child(const std::function<std::string()>& work, const std::string& on_death,
                              std::chrono::milliseconds patience) {
  return result_of([&](int to_parent) { return work_confined(work, to_parent); }, on_death, patience);
}

std::string from_confined_program(const std::string& name, const std::vector<std::string>& arguments,
                                  std::string_view input, const std::string& on_death,
                                  std::chrono::milliseconds patience) {
  // allocates everything before the fork
  std::string program = find_program(name);
  std::vector<std::string> all = arguments;
  std::vector<char*> raw{program.data()};
  for (std::string& argument : all) raw.push_back(argument.data());
  raw.push_back(nullptr);
  const core::FileDescriptor file = unnamed_file(input);
  return result_of(
      [&](int to_parent) {
        if (::dup2(to_parent, STDOUT_FILENO) >= 0 && ::dup2(file.get(), STDIN_FILENO) >= 0) {
          keep_only({STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO});
          ::execv(raw.front(), raw.data());
        }
        return ChildExit::Failed;
      },
      on_death, patience);
}

}  // namespace afm::curves
