// SPDX-License-Identifier: Apache-2.0
#include "servo/servo_process.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <utility>
#include <vector>

#include "core/clock.h"
#include "core/log.h"
#include "core/system_error.h"

namespace afm::servo {

namespace {

constexpr int kTerminateMs = 500;

// The numbers under which the child finds what it inherits.
constexpr int kSegmentInChild = 3;
constexpr int kLifelineInChild = 4;
constexpr int kFirstClosedInChild = 5;

scene::RendererHeartbeat goodbye() { return {.time_ns = core::MonotonicClock().now_ns(), .frame = 0, .leaving = 1}; }

core::Error spawn_error(const std::string& program, int error) {
  return {core::ErrorCategory::Failed,
          fmt::format("cannot start the servo {}: {}; build the target touchafm-servo and keep it beside touchafm",
                      program, core::system_error(error))};
}

// What posix_spawn needs, freed in any case.
class SpawnPlan {
 public:
  SpawnPlan() {
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawnattr_init(&attributes);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
  ~SpawnPlan() {
    ::posix_spawn_file_actions_destroy(&actions);
    ::posix_spawnattr_destroy(&attributes);
  }

  // The two descriptors and the standard streams, and no others: a lifeline that a third process also held would not
  // break. A process group of its own, so that Ctrl-C in a terminal reaches the servo through the renderer, in good
  // order.
  int fill(int segment, int lifeline) {
    sigset_t none;
    ::sigemptyset(&none);
    for (const int error :
         {::posix_spawn_file_actions_adddup2(&actions, segment, kSegmentInChild),
          ::posix_spawn_file_actions_adddup2(&actions, lifeline, kLifelineInChild),
          ::posix_spawn_file_actions_addclosefrom_np(&actions, kFirstClosedInChild),
          ::posix_spawnattr_setsigmask(&attributes, &none), ::posix_spawnattr_setpgroup(&attributes, 0),
          ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP)}) {
      if (error != 0) return error;
    }
    return 0;
  }

  posix_spawn_file_actions_t actions{};
  posix_spawnattr_t attributes{};
};

// A copy whose number does not collide with those that the child will use.
core::FileDescriptor out_of_the_way(int descriptor) {
  return core::FileDescriptor(::fcntl(descriptor, F_DUPFD_CLOEXEC, kFirstClosedInChild));
}

}  // namespace

core::Result<std::unique_ptr<ServoProcess>> ServoProcess::spawn(const std::string& program,
                                                                scene::SharedSegment& segment,
                                                                scene::RendererSide& side,
                                                                const haptics::ServoSettings& settings,
                                                                const std::string& device) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return tl::unexpected(spawn_error(program, errno));
  }
  core::FileDescriptor ours(ends[0]);
  core::FileDescriptor theirs(ends[1]);
  const core::FileDescriptor segment_copy = out_of_the_way(segment.descriptor());
  const core::FileDescriptor lifeline_copy = out_of_the_way(theirs.get());
  if (!segment_copy.is_open() || !lifeline_copy.is_open()) return tl::unexpected(spawn_error(program, errno));

  std::vector<std::string> arguments{program,
                                     "--segment",
                                     std::to_string(kSegmentInChild),
                                     "--parent-socket",
                                     std::to_string(kLifelineInChild),
                                     "--linger",
                                     fmt::format("{}", settings.linger_s)};
  for (std::string& argument : servo_arguments(settings, device)) arguments.push_back(std::move(argument));
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);

  SpawnPlan plan;
  pid_t pid = -1;
  int error = plan.fill(segment_copy.get(), lifeline_copy.get());
  if (error == 0) error = ::posix_spawn(&pid, program.c_str(), &plan.actions, &plan.attributes, argv.data(), environ);
  if (error != 0) return tl::unexpected(spawn_error(program, error));
  return std::unique_ptr<ServoProcess>(new ServoProcess(pid, std::move(ours), side));
}

ServoProcess::~ServoProcess() {
  if (!alive()) return;
  side_.store(goodbye());
  if (ended_within(kLeaveMs)) return;
  ::kill(pid_, SIGTERM);
  if (ended_within(kTerminateMs)) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

bool ServoProcess::alive() noexcept { return !exit_status().has_value(); }

std::optional<int> ServoProcess::exit_status() noexcept {
  if (!exit_status_) {
    int status = 0;
    const pid_t ended = ::waitpid(pid_, &status, WNOHANG);
    if (ended == pid_) exit_status_ = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    if (ended < 0 && errno == ECHILD) exit_status_ = 1;  // somebody else has reaped it
  }
  return exit_status_;
}

bool ServoProcess::ended_within(int milliseconds) noexcept {
  for (int waited = 0; alive(); ++waited) {
    if (waited >= milliseconds) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

std::unique_ptr<AdoptedServo> AdoptedServo::adopt(WaitingServo waiting, scene::RendererSide& side) {
  waiting.stay();
  return std::unique_ptr<AdoptedServo>(new AdoptedServo(std::move(waiting), side));
}

AdoptedServo::~AdoptedServo() {
  if (!alive()) return;
  side_.store(goodbye());
  if (process_ended_within(waiting_.process, kLeaveMs)) return;
  ::syscall(SYS_pidfd_send_signal, waiting_.process.get(), SIGTERM, nullptr, 0);
  if (process_ended_within(waiting_.process, kTerminateMs)) return;
  ::syscall(SYS_pidfd_send_signal, waiting_.process.get(), SIGKILL, nullptr, 0);
}

std::optional<int> AdoptedServo::exit_status() noexcept {
  // its status goes to its own parent
  return process_ended_within(waiting_.process, 0) ? std::optional(1) : std::nullopt;
}

core::Result<std::unique_ptr<ServoThread>> ServoThread::start(scene::SharedSegment& segment, scene::RendererSide& side,
                                                              const haptics::ServoSettings& settings,
                                                              std::unique_ptr<haptics::HapticDevice> device) {
  auto loop = haptics::ServoLoop::create(segment, *device, settings);
  if (!loop) return tl::unexpected(loop.error());
  return std::unique_ptr<ServoThread>(new ServoThread(std::move(device), std::move(*loop), side));
}

ServoThread::ServoThread(std::unique_ptr<haptics::HapticDevice> device, std::unique_ptr<haptics::ServoLoop> loop,
                         scene::RendererSide& side)
    : device_(std::move(device)), loop_(std::move(loop)), edits_(loop_->edits()), side_(side), thread_([this] {
        const haptics::RealtimeGrant grant = haptics::enter_realtime(haptics::kServoPriority, haptics::PageLock::Leave);
        for (const std::string& note : grant.notes) core::log_line(note);
        loop_->note_grant(grant);
        loop_->run(core::MonotonicClock());
        exit_status_.store(0);
      }) {}

ServoThread::~ServoThread() {
  side_.store(goodbye());
  thread_.join();
}

std::optional<int> ServoThread::exit_status() noexcept {
  const int status = exit_status_.load();
  return status == kRunning ? std::nullopt : std::optional<int>(status);
}

}  // namespace afm::servo
