// SPDX-License-Identifier: Apache-2.0
#include "app/bench/servo_reaction.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <thread>

#include "app/bench/servo_work.h"
#include "core/clock.h"
#include "core/log.h"
#include "scene/shared/shared_segment.h"
#include "servo/servo_process.h"

namespace afm::app {

namespace {

using scene::TipState;

constexpr double kHeld_n = 0.5;
constexpr int kTriesPerRound = 5;
constexpr auto kPatience = std::chrono::seconds(10);

bool holds(scene::RendererSide& side) {
  const auto state = side.tip_state();
  return state && state->servo_state == scene::ServoState::Running && std::abs(state->hand.force_n[1]) > kHeld_n;
}

// Repeats `act` until the condition holds.
bool until(const std::function<void()>& act, const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    act();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

std::atomic<bool> stop_pressed{false};

// The renderer's process: a simulated person puts the tip on the sample once, and the heartbeat continues until the
// process dies. SIGUSR1 means Stop.
[[noreturn]] void draw(const std::string& servo_program, scene::SharedSegment& segment) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::signal(SIGUSR1, [](int) { stop_pressed = true; });
  scene::RendererSide side = segment.renderer_side();
  auto servo = servo::ServoProcess::spawn(servo_program, segment, side, {});
  if (!servo) ::_exit(1);
  const core::MonotonicClock clock;
  const auto beat = [&] {
    side.store(scene::RendererHeartbeat{.time_ns = clock.now_ns(), .stop = stop_pressed ? 1U : 0U});
  };
  side.store(scene::Selection{.material = 0, .revision = 1});
  struct Move {
    double height_m, seconds;
    bool pressed;
  };
  std::uint32_t revision = 0;
  for (const Move& move : {Move{0.060, 0.3, false}, Move{0.060, 0.1, true}, Move{0.060, 0.5, false},
                           Move{-0.010, 0.3, false}, Move{0.025, 0.3, false}}) {
    side.store(scene::HandScript{.target_m = {0, move.height_m, 0},
                                 .duration_s = move.seconds,
                                 .revision = ++revision,
                                 .turn_on_pressed = move.pressed ? 1U : 0U});
    until(beat, [&] {
      const auto state = side.tip_state();
      return state && state->acknowledged.hand_script == revision;
    });
  }
  for (;;) until(beat, [] { return false; });
}

// Sends the signal and returns how long the force lasted. Empty if there was no force before it.
std::optional<double> one_round(const std::string& servo_program, const Release& release) {
  auto segment = scene::SharedSegment::create(mica_alone(), 0);
  if (!segment) return std::nullopt;
  scene::RendererSide side = segment->renderer_side();
  const pid_t renderer = ::fork();
  if (renderer == 0) draw(servo_program, *segment);
  const auto nothing = [] {};
  std::optional<double> lasted_ms;
  if (until(nothing, [&] { return holds(side); })) {
    while (side.pop_sample()) {
    }
    const std::int64_t end_ns = core::MonotonicClock().now_ns();
    ::kill(renderer, release.signal);
    std::int64_t released_ns = 0;
    until(nothing, [&] {
      while (const auto sample = side.pop_sample()) {
        if (released_ns == 0 && sample->time_ns >= end_ns && sample->hand_force_n == 0.0) released_ns = sample->time_ns;
      }
      return released_ns != 0;
    });
    const auto state = side.tip_state();
    if (released_ns != 0 && state && state->fault == release.fault) {
      lasted_ms = 1e-6 * static_cast<double>(released_ns - end_ns);
    }
  }
  ::kill(renderer, SIGKILL);
  ::waitpid(renderer, nullptr, 0);
  // the orphaned servo is now this process's child
  ::waitpid(-1, nullptr, 0);
  return lasted_ms;
}

}  // namespace

core::Result<std::vector<double>> measure_reaction(const std::string& program, const Release& release, int rounds) {
  ::prctl(PR_SET_CHILD_SUBREAPER, 1UL, 0UL, 0UL, 0UL);
  const std::string servo = std::filesystem::path(program).replace_filename("touchafm-servo").string();
  std::vector<double> lasted_ms;
  for (int tried = 0; static_cast<int>(lasted_ms.size()) < rounds; ++tried) {
    if (tried >= rounds * kTriesPerRound) {
      return core::failure(core::ErrorCategory::Failed,
                           "the servo does not hold the hand long enough for a measurement: close other programs");
    }
    core::log_line(fmt::format("the renderer {} while the servo holds the hand ({} of {})", release.what,
                               lasted_ms.size() + 1, rounds));
    if (const auto one = one_round(servo, release)) lasted_ms.push_back(*one);
  }
  return lasted_ms;
}

}  // namespace afm::app
