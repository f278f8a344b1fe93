// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/clock.h"
#include "core/exit_code.h"
#include "core/file_descriptor.h"
#include "core/log.h"
#include "core/own_folder.h"
#include "core/run_main.h"
#include "haptics/edit_thread.h"
#include "haptics/realtime.h"
#include "haptics/servo_loop.h"
#include "scene/shared/shared_segment.h"
#include "servo/haptic_choice.h"
#include "servo/release_link.h"
#include "servo/renderer_monitor.h"
#include "servo/servo_handover.h"
#include "servo/watchdog.h"

// touchafm-servo: the process that holds the hand. Its main thread is the servo; a second thread watches the renderer;
// a third, which is not real-time, prepares the changes that visitors make. touchafm-guard, a process, watches it.
namespace {

using namespace std::string_view_literals;
using afm::core::ExitCode;

struct Options {
  int segment = -1;
  int parent_socket = -1;
  afm::haptics::ServoSettings settings;
  int dead_man = 0;  // 1: force only while Turn-On is held
  std::string_view haptics = "sim";
};

template <class Number>
bool parse(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

std::optional<Options> parse_options(int count, char** arguments) {
  Options options;
  for (int i = 1; i < count; i += 2) {
    const std::string_view name = arguments[i];
    if (i + 1 == count) return std::nullopt;
    const std::string_view value = arguments[i + 1];
    const bool parsed = (name == "--segment"sv && parse(value, options.segment)) ||
                        (name == "--parent-socket"sv && parse(value, options.parent_socket)) ||
                        (name == "--rate"sv && parse(value, options.settings.rate_hz)) ||
                        (name == "--linger"sv && parse(value, options.settings.linger_s)) ||
                        (name == "--max-force"sv && parse(value, options.settings.max_force_n)) ||
                        (name == "--spin"sv && parse(value, options.settings.spin_ns)) ||
                        (name == "--dead-man"sv && parse(value, options.dead_man)) || name == "--haptics"sv;
    if (name == "--haptics"sv) options.haptics = value;
    if (!parsed) return std::nullopt;
  }
  if (options.segment < 0 || options.parent_socket < 0) return std::nullopt;
  options.settings.dead_man = options.dead_man != 0;
  return options;
}

// Turns the signals that end a program into readable events; every thread created from here on inherits the mask. The
// kernel sends SIGHUP, too, to a stopped servo whose renderer has died.
afm::core::FileDescriptor catch_signals() {
  sigset_t ending;
  ::sigemptyset(&ending);
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) ::sigaddset(&ending, signal);
  ::pthread_sigmask(SIG_BLOCK, &ending, nullptr);
  return afm::core::FileDescriptor(::signalfd(-1, &ending, SFD_CLOEXEC));
}

std::string guard_program() { return afm::core::own_program().replace_filename("touchafm-guard").string(); }

ExitCode run(const Options& options) {
  afm::core::FileDescriptor parent_socket(options.parent_socket);
  auto segment = afm::scene::SharedSegment::attach(afm::core::FileDescriptor(options.segment));
  if (!segment) {
    afm::core::log_line(segment.error().message);
    return afm::core::exit_code(segment.error().category);
  }
  // a device may start threads, which must leave the signals to the monitor
  const afm::core::FileDescriptor signals = catch_signals();
  const auto watchdog = afm::servo::Watchdog::start(guard_program(), segment->descriptor());
  if (!watchdog) {
    afm::core::log_line(watchdog.error().message);
    return afm::core::exit_code(watchdog.error().category);
  }
  const afm::core::MonotonicClock clock;
  afm::servo::ReleaseLink link((*watchdog)->descriptor(), parent_socket.get());
  const auto offer = [&](const afm::haptics::ReleasePath& path) { link.offer(path); };
  const auto choice = afm::servo::parse_haptic_choice(options.haptics);
  auto opened = choice ? afm::servo::open_haptic_device(*choice, clock, offer) : tl::unexpected(choice.error());
  if (!opened) {
    afm::core::log_line(opened.error().message);
    return afm::core::exit_code(opened.error().category);
  }
  auto loop = afm::haptics::ServoLoop::create(*segment, *opened->device, options.settings);
  if (!loop) {
    afm::core::log_line(loop.error().message);
    // another start with this scene and device would fail, too
    return loop.error().category == afm::core::ErrorCategory::Failed ? ExitCode::BadInputFile
                                                                     : afm::core::exit_code(loop.error().category);
  }

  afm::haptics::ServoExit exit{};
  {
    const afm::haptics::EditThread edits((*loop)->edits());
    const afm::servo::RendererMonitor watch(
        **loop, std::move(parent_socket), signals, (*watchdog)->descriptor(), link,
        {.seconds = options.settings.linger_s,
         .program = afm::core::own_program().string(),
         .segment = segment->descriptor(),
         .scene_digest = segment->scene_digest(),
         .arguments = afm::servo::servo_arguments(options.settings, std::string(options.haptics))});
    const auto grant = afm::haptics::enter_realtime(afm::haptics::kServoPriority, afm::haptics::PageLock::Lock);
    for (const std::string& note : grant.notes) afm::core::log_line(note);
    (*loop)->note_grant(grant);
    exit = (*loop)->run(clock);
    link.expect_end();
  }
  if (exit == afm::haptics::ServoExit::RendererDied) {
    afm::core::log_line("the renderer died: force released");
    return ExitCode::RunFailed;
  }
  return ExitCode::Done;
}

}  // namespace

int main(int count, char** arguments) {
  // A stopped servo continues when its renderer dies, so that it can release the hand. The kernel does the same for an
  // orphaned process group, but never for one of which a thread was still waiting for a processor to stop on.
  ::prctl(PR_SET_PDEATHSIG, static_cast<unsigned long>(SIGCONT), 0UL, 0UL, 0UL);
  // a closed stderr, whose reader died with the renderer, must not end the servo
  ::signal(SIGPIPE, SIG_IGN);
  const auto options = parse_options(count, arguments);
  if (!options) {
    afm::core::log_line("touchafm starts this program; run 'touchafm demo --out DIR' instead");
    return static_cast<int>(ExitCode::WrongUsage);
  }
  return afm::core::report_exceptions([&] { return static_cast<int>(run(*options)); });
}
