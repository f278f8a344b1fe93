// SPDX-License-Identifier: Apache-2.0
#include "servo/keep_running.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <deque>
#include <optional>
#include <thread>

#include "core/exit_code.h"
#include "core/interruption.h"
#include "core/log.h"
#include "core/system_error.h"

namespace afm::servo {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kLook = std::chrono::milliseconds(50);  // interval for checking the program and signals
constexpr auto kBeforeRestart = std::chrono::milliseconds(1000);
constexpr auto kMinute = std::chrono::minutes(1);

core::Error cannot_start(const std::string& program, int error) {
  return {core::ErrorCategory::Failed, fmt::format("cannot start {}: {}", program, core::system_error(error))};
}

// Runs in the child; makes only calls that are safe there, as this process has other threads. Writes errno on failure.
[[noreturn]] void become(const char* program, char* const* words, int beats, int report, pid_t parent) {
  sigset_t none;
  ::sigemptyset(&none);
  // a killed keeper leaves no window that nobody reopens; unlike its end, this also reaches a stopped program
  const bool kept = ::prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 && ::getppid() == parent;
  if (kept && ::dup2(beats, kBeatDescriptor) >= 0 && ::pthread_sigmask(SIG_SETMASK, &none, nullptr) == 0)
    ::execv(program, words);
  const int error = errno;
  [[maybe_unused]] const auto written = ::write(report, &error, sizeof(error));
  ::_exit(127);
}

struct Ends {
  core::FileDescriptor ours, theirs;
};

core::Result<Ends> connect_to(const std::string& program) {
  constexpr int kOutOfTheWay = kBeatDescriptor + 1;  // dup2() to itself would keep the close-on-exec flag
  std::array<int, 2> raw{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, raw.data()) != 0)
    return tl::unexpected(cannot_start(program, errno));
  Ends ends{core::FileDescriptor(raw[0]), core::FileDescriptor(raw[1])};
  ends.theirs = core::FileDescriptor(::fcntl(raw[1], F_DUPFD_CLOEXEC, kOutOfTheWay));
  if (!ends.theirs.is_open()) return tl::unexpected(cannot_start(program, errno));
  return ends;
}

struct Kept {
  pid_t pid = -1;
  core::FileDescriptor beats;
};

core::Result<Kept> start(const std::string& program, const std::vector<std::string>& arguments) {
  auto beats = connect_to(program);
  if (!beats) return tl::unexpected(beats.error());
  auto report = connect_to(program);
  if (!report) return tl::unexpected(report.error());
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> raw;
  raw.reserve(words.size() + 1);
  for (std::string& word : words) raw.push_back(word.data());
  raw.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid < 0) return tl::unexpected(cannot_start(program, errno));
  if (pid == 0) become(program.c_str(), raw.data(), beats->theirs.get(), report->theirs.get(), parent);
  report->theirs.close();
  // closed by the program's start, or with the reason for none
  pollfd started{.fd = report->ours.get(), .events = POLLIN, .revents = 0};
  while (::poll(&started, 1, -1) < 0 && errno == EINTR) {
  }
  int error = 0;
  if (::read(report->ours.get(), &error, sizeof(error)) == sizeof(error)) {
    ::waitpid(pid, nullptr, 0);
    return tl::unexpected(cannot_start(program, error));
  }
  return Kept{pid, std::move(beats->ours)};
}

// Measures time in looks: a pause between two looks in which this process did not run counts little.
class Patience {
 public:
  void look() {
    const Clock::time_point now = Clock::now();
    passed_ += std::min<Clock::duration>(now - seen_, 4 * kLook);
    seen_ = now;
  }
  void begin() { passed_ = {}; }
  bool exceeds(std::chrono::milliseconds limit) const { return passed_ > limit; }

 private:
  Clock::time_point seen_ = Clock::now();
  Clock::duration passed_{};
};

bool take_beats(int descriptor) {
  std::array<char, 4096> bytes{};
  bool came = false;
  while (::read(descriptor, bytes.data(), bytes.size()) > 0) came = true;
  return came;
}

enum class Ending { ByItself, Silent, Late };

struct Ended {
  int status = 0;
  Ending ending = Ending::ByItself;
  bool beaten = false;  // true: the program has drawn
};

// Waits for the end of the program, and ends it if it hangs; passes on a signal to it once.
Ended wait_for(const Kept& kept, const KeepLimits& limits) {
  Patience silence, since_signal;
  bool handed_on = false;
  Ended ended;
  for (;;) {
    if (::waitpid(kept.pid, &ended.status, WNOHANG) == kept.pid) return ended;
    silence.look();
    since_signal.look();
    if (take_beats(kept.beats.get())) {
      ended.beaten = true;
      silence.begin();
    }
    if (core::interrupted() && !handed_on) {
      handed_on = true;
      since_signal.begin();
      ::kill(kept.pid, SIGTERM);
    }
    const bool late = handed_on && since_signal.exceeds(limits.end);
    const bool silent = !handed_on && silence.exceeds(ended.beaten ? limits.silence : limits.start);
    if ((late || silent) && ended.ending == Ending::ByItself) {
      ended.ending = late ? Ending::Late : Ending::Silent;
      ::kill(kept.pid, SIGKILL);
    }
    std::this_thread::sleep_for(kLook);
  }
}

double seconds(std::chrono::milliseconds time) { return std::chrono::duration<double>(time).count(); }

std::string end_of(const Ended& ended, const KeepLimits& limits) {
  if (ended.ending == Ending::Silent)
    return fmt::format("hung: no frame for {:g} s", seconds(ended.beaten ? limits.silence : limits.start));
  return WIFSIGNALED(ended.status) ? fmt::format("crashed with signal {}", WTERMSIG(ended.status))
                                   : fmt::format("ended with exit code {}", WEXITSTATUS(ended.status));
}

// Category of a failure that another start would repeat.
std::optional<core::ErrorCategory> refusal_of(int status) {
  if (!WIFEXITED(status)) return std::nullopt;
  switch (static_cast<core::ExitCode>(WEXITSTATUS(status))) {
    case core::ExitCode::WrongUsage:
      return core::ErrorCategory::WrongUsage;
    case core::ExitCode::BadInputFile:
      return core::ErrorCategory::BadInputFile;
    case core::ExitCode::DeviceMissing:
      return core::ErrorCategory::DeviceMissing;
    default:
      return std::nullopt;
  }
}

}  // namespace

core::Result<void> keep_running(const std::string& program, const std::vector<std::string>& arguments,
                                const KeepLimits& limits) {
  const core::OrderlyEnd by_itself;
  std::deque<Clock::time_point> failures;
  while (!core::interrupted()) {
    const auto kept = start(program, arguments);
    if (!kept) return tl::unexpected(kept.error());
    const Ended ended = wait_for(*kept, limits);
    if (ended.ending == Ending::Late) {
      return core::failure(core::ErrorCategory::Failed,
                           fmt::format("the window did not end within {:g} s and was killed", seconds(limits.end)));
    }
    if (core::interrupted() || (WIFEXITED(ended.status) && WEXITSTATUS(ended.status) == 0)) return {};
    if (const auto refused = refusal_of(ended.status))
      return core::failure(*refused, "the window could not be opened; see above");
    const Clock::time_point now = Clock::now();
    failures.push_back(now);
    while (now - failures.front() > kMinute) failures.pop_front();
    if (failures.size() > static_cast<std::size_t>(kMostRestarts)) {
      return core::failure(core::ErrorCategory::Failed,
                           fmt::format("the window {} {} times within a minute; see its last messages above",
                                       end_of(ended, limits), failures.size()));
    }
    core::log_line(fmt::format("the window {}; reopening it", end_of(ended, limits)));
    std::this_thread::sleep_for(kBeforeRestart);
  }
  return {};
}

core::Result<KeptBeat> KeptBeat::at(int descriptor) {
  struct stat kind{};
  if (::fstat(descriptor, &kind) != 0 || !S_ISSOCK(kind.st_mode)) {
    return core::wrong_usage(
        fmt::format("--kept: descriptor {} is not a socket; this option is for view --kiosk alone", descriptor));
  }
  ::fcntl(descriptor, F_SETFD, FD_CLOEXEC);  // descriptor hidden from programs that this one starts
  return KeptBeat(core::FileDescriptor(descriptor));
}

bool KeptBeat::beat() noexcept {
  const char beat = 1;
  // a keeper that reads late has unread beats
  return ::send(socket_.get(), &beat, 1, MSG_NOSIGNAL | MSG_DONTWAIT) == 1 || errno == EAGAIN;
}

}  // namespace afm::servo
