// SPDX-License-Identifier: Apache-2.0
#include "confined/confined_child.h"

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
#include <cstdint>
#include <cstring>
#include <exception>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <utility>

#include "confined/confinement.h"
#include "core/file_descriptor.h"
#include "core/own_folder.h"
#include "core/system_error.h"
#include "core/write_all.h"
#include "curves/curve_error.h"

namespace afm::curves {

namespace {

using Clock = std::chrono::steady_clock;

// more than the text of the largest curve
constexpr std::size_t kMostResultBytes = std::size_t{1} << 30U;
constexpr int kPipeBytes = 1 << 18;

// Appends what the other end has written, at most `most` bytes; waits for it until `end`.
enum class Came { Bytes, Nothing, Late };  // result of a read; Nothing: the other end is closed
Came append_from(int descriptor, std::size_t most, Clock::time_point end, std::string& bytes) {
  constexpr std::size_t kAtOnce = 65536;
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
    pollfd watched{.fd = descriptor, .events = POLLIN, .revents = 0};
    if (left.count() <= 0) return Came::Late;
    if (::poll(&watched, 1, static_cast<int>(left.count())) <= 0) continue;
    char buffer[kAtOnce];
    const ssize_t count = ::read(descriptor, buffer, std::min(sizeof(buffer), most));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return Came::Nothing;
    bytes.append(buffer, static_cast<std::size_t>(count));
    return Came::Bytes;
  }
}

// Reads `most` bytes, or all until the other end is closed. Empty if neither happens before `end`.
std::optional<std::string> read_until(int descriptor, std::size_t most, Clock::time_point end) {
  std::string bytes;
  while (bytes.size() < most) {
    const Came came = append_from(descriptor, most - bytes.size(), end, bytes);
    if (came == Came::Late) return std::nullopt;
    if (came == Came::Nothing) break;
  }
  return bytes;
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

// Work of a child: data written to the descriptor go to the parent.
using ChildWork = std::function<ChildExit(int to_parent)>;

ChildExit work_confined(const std::function<void()>& work, std::chrono::seconds processor_time, int to_parent) {
  try {
    const auto [lower, upper] = std::minmax({to_parent, STDERR_FILENO});
    keep_only({lower, upper});
    confine_this_process(processor_time);
    work();
    return ChildExit::Done;
  } catch (const CurveError& fault) {
    return core::write_all(to_parent, fault.what()) == 0 ? ChildExit::Fault : ChildExit::Failed;
  } catch (const std::exception&) {
    return ChildExit::Failed;
  }
}

struct Forked {
  pid_t child;
  core::FileDescriptor from_child;
};

// The child neither runs the parent's destructors nor flushes its buffers.
Forked forked(const ChildWork& work) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw std::runtime_error(std::string("cannot make a pipe: ") + core::system_error(errno));
  core::FileDescriptor from_child(ends[0]), to_parent(ends[1]);
  // a child that need not wait for its parent works while that one fits; less room is no fault
  ::fcntl(ends[1], F_SETPIPE_SZ, kPipeBytes);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error(std::string("cannot start a process: ") + core::system_error(errno));
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const bool orphan = ::getppid() != parent;  // true: the parent died earlier
    ::_exit(static_cast<int>(orphan ? ChildExit::Failed : work(to_parent.get())));
  }
  return {child, std::move(from_child)};
}

[[noreturn]] void throw_late(std::chrono::milliseconds patience) {
  throw CurveError(fmt::format("reading it took longer than {:g} s", std::chrono::duration<double>(patience).count()));
}

[[noreturn]] void throw_death(int status, const std::string& on_death) {
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (signal != SIGXCPU && signal != SIGKILL) throw CurveError(on_death);
  throw CurveError("reading it takes too long, or more memory than there is");
}

// Complete output of a child.
std::string result_of(const ChildWork& work, const std::string& on_death, std::chrono::milliseconds patience) {
  const Forked forked_child = forked(work);
  const auto end = Clock::now() + patience;
  const auto bytes = read_until(forked_child.from_child.get(), kMostResultBytes, end);
  int status = 0;
  const bool ended = bytes && bytes->size() < kMostResultBytes && ended_by(end, forked_child.child, status);
  if (!ended) {
    ::kill(forked_child.child, SIGKILL);
    ::waitpid(forked_child.child, &status, 0);
    if (bytes && bytes->size() == kMostResultBytes) throw CurveError("it is too large");
    throw_late(patience);
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == static_cast<int>(ChildExit::Done)) return *bytes;
  if (WIFEXITED(status) && WEXITSTATUS(status) == static_cast<int>(ChildExit::Fault)) throw CurveError(*bytes);
  throw_death(status, on_death);
}

// Path of the program with that name.
std::string find_program(const std::string& name) {
  const std::filesystem::path here = core::own_folder();
  // the Python module lies in PREFIX/lib/python3/dist-packages/touchafm, of a build as of an installation
  const std::filesystem::path prefix = here / "../../../..";
  for (const std::filesystem::path& folder :
       {here, here.parent_path() / "bin", prefix / "libexec/touchafm", prefix / "bin"}) {
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

// Runs one of our programs in a child, with `input` on stdin and the pipe on stdout. Everything is allocated before the
// fork.
class ProgramWork {
 public:
  ProgramWork(const std::string& name, const std::vector<std::string>& arguments, std::string_view input)
      : program_(find_program(name)), arguments_(arguments), input_(unnamed_file(input)) {
    raw_.push_back(program_.data());
    for (std::string& argument : arguments_) raw_.push_back(argument.data());
    raw_.push_back(nullptr);
  }

  ChildExit operator()(int to_parent) const {
    if (::dup2(to_parent, STDOUT_FILENO) >= 0 && ::dup2(input_.get(), STDIN_FILENO) >= 0) {
      keep_only({STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO});
      ::execv(raw_.front(), raw_.data());
    }
    return ChildExit::Failed;
  }

 private:
  std::string program_;
  std::vector<std::string> arguments_;
  std::vector<char*> raw_;
  core::FileDescriptor input_;
};

// Head of a message, before its text.
struct MessageHead {
  std::uint64_t size = 0;
  std::uint64_t fault = 0;
};

void put_message_to(int descriptor, const ChildMessage& message) {
  const MessageHead head{message.text.size(), message.fault ? 1U : 0U};
  std::string bytes(sizeof(head), '\0');
  std::memcpy(bytes.data(), &head, sizeof(head));
  bytes += message.text;
  if (core::write_all(descriptor, bytes) != 0) throw std::runtime_error("nobody reads the messages any more");
}

}  // namespace

std::string in_confined_child(const std::function<std::string()>& work, const std::string& on_death,
                              const ChildTime& time) {
  return result_of(
      [&](int to_parent) {
        const auto write = [&] {
          if (core::write_all(to_parent, work()) != 0) throw std::runtime_error("nobody reads the result");
        };
        return work_confined(write, time.processor_time, to_parent);
      },
      on_death, time.patience);
}

std::string from_confined_program(const std::string& name, const std::vector<std::string>& arguments,
                                  std::string_view input, const std::string& on_death, const ChildTime& time) {
  const ProgramWork work(name, arguments, input);
  return result_of([&](int to_parent) { return work(to_parent); }, on_death, time.patience);
}

void put_message(const ChildMessage& message) { put_message_to(STDOUT_FILENO, message); }

ConfinedStream::ConfinedStream(const std::function<void(const PutMessage&)>& work, const char* on_death,
                               const ChildTime& time)
    : on_death_(on_death), patience_(time.patience) {
  Forked made = forked([&](int to_parent) {
    const auto put = [&] {
      try {
        work([to_parent](const ChildMessage& message) { put_message_to(to_parent, message); });
      } catch (const CurveError& fault) {
        put_message_to(to_parent, {true, fault.what()});
      }
    };
    return work_confined(put, time.processor_time, to_parent);
  });
  child_ = made.child;
  from_child_ = std::move(made.from_child);
}

ConfinedStream::ConfinedStream(const std::string& name, const std::vector<std::string>& arguments,
                               std::string_view input, const char* on_death, const ChildTime& time)
    : on_death_(on_death), patience_(time.patience) {
  const ProgramWork work(name, arguments, input);
  Forked made = forked([&](int to_parent) { return work(to_parent); });
  child_ = made.child;
  from_child_ = std::move(made.from_child);
}

ConfinedStream::~ConfinedStream() {
  if (child_ < 0) return;
  ::kill(child_, SIGKILL);
  ::waitpid(child_, nullptr, 0);
}

std::optional<std::string_view> ConfinedStream::bytes(std::size_t count, Clock::time_point end) {
  while (unread_.size() - read_ < count) {
    unread_.erase(0, read_);
    read_ = 0;
    const Came came = append_from(from_child_.get(), kMostResultBytes, end, unread_);
    if (came == Came::Late) return std::nullopt;
    if (came == Came::Nothing) break;
  }
  const std::string_view found = std::string_view(unread_).substr(read_, count);
  read_ += found.size();
  return found;
}

std::optional<ChildMessage> ConfinedStream::next() {
  if (child_ < 0) return std::nullopt;
  const auto end = Clock::now() + patience_;
  MessageHead head;
  const auto begun = bytes(sizeof(head), end);
  if (!begun) throw_late(patience_);
  if (begun->size() == sizeof(head)) {
    std::memcpy(&head, begun->data(), sizeof(head));
    if (head.size > kMostResultBytes) throw CurveError(on_death_);
    const auto text = bytes(head.size, end);
    if (!text) throw_late(patience_);
    if (text->size() < head.size) throw CurveError(on_death_);
    return ChildMessage{head.fault != 0, std::string(*text)};
  }
  int status = 0;
  if (!ended_by(end, child_, status)) throw_late(patience_);
  child_ = -1;
  if (WIFEXITED(status) && WEXITSTATUS(status) == static_cast<int>(ChildExit::Done)) return std::nullopt;
  throw_death(status, on_death_);
}

}  // namespace afm::curves
