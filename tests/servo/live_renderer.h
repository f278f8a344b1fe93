// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "core/clock.h"
#include "servo/servo_process.h"
#include "support/paper_model.h"
#include "support/places.h"

// Actions of touchafm for a servo in real time, for tests with real processes. The test machine may stall for many
// milliseconds at any moment, and the servo then correctly releases the hand. So an action that needs the hand to be
// held must be repeatable, and waits have generous limits.
namespace afm::test {

inline const std::string kServoProgram = support::built("bin/touchafm-servo");
inline constexpr double kRateHz = 1000.0;
inline constexpr auto kPatience = std::chrono::seconds(100);

inline std::int64_t now_ns() { return core::MonotonicClock().now_ns(); }

inline void wait_a_little() { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }

inline bool eventually(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    wait_a_little();
  }
  return true;
}

inline scene::SharedSegment create_segment() { return std::move(*scene::SharedSegment::create(paper_model(), 0)); }

// Newest state. A single read may find the state of a running servo half written.
inline scene::TipState tip_state_of(scene::RendererSide& side) {
  std::optional<scene::TipState> state;
  eventually([&] { return (state = side.tip_state()).has_value(); });
  return state.value();
}

// True if the tip hangs on the sample and the hand feels more than half a newton.
inline bool holds(scene::RendererSide& side) {
  const auto state = side.tip_state();
  return state && state->servo_state == scene::ServoState::Running && state->hand.force_n[1] < -0.5;
}

// Sends heartbeats while waiting, and acts as a person who holds the simulated hand.
class LiveRenderer {
 public:
  explicit LiveRenderer(scene::RendererSide& side) : side_(side) {}

  void beat() { side_.store(scene::RendererHeartbeat{.time_ns = now_ns(), .frame = ++frame_}); }

  bool until(const std::function<bool(const scene::TipState&)>& condition) {
    return eventually([&] {
      beat();
      const auto state = side_.tip_state();
      return state && condition(*state);
    });
  }

  void aim(double height_m, double seconds, bool pressed = false) {
    side_.store(scene::HandScript{.target_m = {0.0, height_m, 0.0},
                                  .duration_s = seconds,
                                  .revision = ++script_,
                                  .turn_on_pressed = pressed ? 1U : 0U});
  }

  bool played() {
    return until([this](const scene::TipState& state) { return state.acknowledged.hand_script == script_; });
  }

  bool holds() { return test::holds(side_); }

  // Runs the paper's procedure until the tip hangs on mica. If the servo releases the hand before, starts again, as a
  // person would. With a dead man the button stays pressed.
  bool hold_attached(bool dead_man = false) {
    side_.store(scene::Selection{.material = kMica, .revision = 1});
    return eventually([this, dead_man] {
      if (!move(0.060, 0.3) || !move(0.060, 0.1, true)) return false;
      aim(0.060, 0.1, dead_man);
      until([](const scene::TipState& state) { return state.servo_state != scene::ServoState::Arming; });
      if (!move(-0.010, 0.3, dead_man) || !move(0.025, 0.25, dead_man)) return false;
      until([this](const scene::TipState& state) {
        return holds() || state.servo_state == scene::ServoState::Disarmed ||
               state.servo_state == scene::ServoState::Fault;
      });
      return holds();
    });
  }

 private:
  bool move(double height_m, double seconds, bool pressed = false) {
    aim(height_m, seconds, pressed);
    return played();
  }

  scene::RendererSide& side_;
  std::uint64_t frame_ = 0;
  std::uint32_t script_ = 0;
};

}  // namespace afm::test
