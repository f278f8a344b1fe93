// SPDX-License-Identifier: Apache-2.0
#include "servo/servo_process.h"

#include <fmt/core.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <utility>
#include <vector>

#include "child_process.h"
#include "core/clock.h"
#include "core/log.h"
#include "core/system_error.h"
#include "haptics/realtime.h"
#include "haptics/servo_loop.h"
#include "renderer_guard.h"

namespace afm::servo {

namespace {

constexpr int kTerminateMs = 500;
constexpr int kReleaseMs = 200;

scene::RendererHeartbeat goodbye() { return {.time_ns = core::MonotonicClock().now_ns(), .frame = 0, .leaving = 1}; }

}  // namespace

core::Result<std::unique_ptr<ServoProcess>> ServoProcess::spawn(const std::string& program,
                                                                scene::SharedSegment& segment,
                                                                scene::RendererSide& side,
                                                                const haptics::ServoSettings& settings,
                                                                const std::string& device) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot start the servo {}: {}", program, core::system_error(errno)));
  }
  core::FileDescriptor ours(ends[0]);
  const core::FileDescriptor theirs(ends[1]);
  std::vector<std::string> arguments{"--segment",       std::to_string(kInherited[0]),
                                     "--parent-socket", std::to_string(kInherited[1]),
                                     "--linger",        fmt::format("{}", settings.linger_s)};
  for (std::string& argument : servo_arguments(settings, device)) arguments.push_back(std::move(argument));
  const auto process = start_child(program, std::move(arguments), {segment.descriptor(), theirs.get()});
  if (!process) return tl::unexpected(process.error());
  return std::unique_ptr<ServoProcess>(new ServoProcess(*process, std::move(ours), segment, side));
}

// On an interruption SIGTERM makes the servo release the hand, without a message about a dead renderer.
ServoProcess::ServoProcess(pid_t pid, core::FileDescriptor lifeline, scene::SharedSegment& segment,
                           scene::RendererSide& side)
    : pid_(pid),
      process_(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0))),
      lifeline_(std::move(lifeline)),
      side_(side),
      terminate_([pid] { ::kill(pid, SIGTERM); }),
      guard_(std::make_unique<RendererGuard>(lifeline_.get(), process_.get(), segment)) {}

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
  ended_within(0);
  return exit_status_;
}

bool ServoProcess::ended_within(int milliseconds) noexcept {
  int status = 0;
  if (!exit_status_ && child_ended_within(pid_, milliseconds, status)) {
    exit_status_ = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }
  return exit_status_.has_value();
}

std::unique_ptr<AdoptedServo> AdoptedServo::adopt(WaitingServo waiting, scene::SharedSegment& segment,
                                                  scene::RendererSide& side) {
  waiting.stay();
  return std::unique_ptr<AdoptedServo>(new AdoptedServo(std::move(waiting), segment, side));
}

AdoptedServo::AdoptedServo(WaitingServo waiting, scene::SharedSegment& segment, scene::RendererSide& side)
    : waiting_(std::move(waiting)),
      side_(side),
      guard_(std::make_unique<RendererGuard>(waiting_.lifeline.get(), waiting_.process.get(), segment)) {}

AdoptedServo::~AdoptedServo() {
  if (!alive()) return;
  side_.store(goodbye());
  if (process_ended_within(waiting_.process, kLeaveMs)) return;
  ::syscall(SYS_pidfd_send_signal, waiting_.process.get(), SIGTERM, nullptr, 0);
  if (process_ended_within(waiting_.process, kTerminateMs)) return;
  ::syscall(SYS_pidfd_send_signal, waiting_.process.get(), SIGKILL, nullptr, 0);
}

std::optional<int> AdoptedServo::exit_status() noexcept {
  // its own parent gets its status
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
    : device_(std::move(device)),
      loop_(std::move(loop)),
      edits_(loop_->edits()),
      side_(side),
      thread_([this] {
        const haptics::RealtimeGrant grant = haptics::enter_realtime(haptics::kServoPriority, haptics::PageLock::Leave);
        for (const std::string& note : grant.notes) core::log_line(note);
        loop_->note_grant(grant);
        loop_->run(core::MonotonicClock());
        exit_status_.store(0);
      }),
      release_([this] {
        loop_->stop();
        // 90 ms; a servo that does not answer within twice that is stuck
        for (int waited_ms = 0; alive() && waited_ms < kReleaseMs; ++waited_ms) {
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
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
