// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/clock.h"
#include "haptics/servo_loop.h"
#include "scene/shared/shared_segment.h"
#include "support/paper_model.h"

namespace afm::test {

class ManualClock final : public core::Clock {
 public:
  std::int64_t now_ns() const noexcept override { return time_ns.load(); }
  std::atomic<std::int64_t> time_ns{1'000'000'000};
};

// The servo and a mock of a vendor's library, in time advanced only by tick(). No person holds the mock's device: it
// keeps its position. `Mock` has the mock's functions under common names:
//
//   using Device, Health;
//   kContactMm: height of the contact point, above which move_to() counts
//   open(clock), reset(), tick(device, time_ns), set_position(x_mm, y_mm, z_mm) to the right, up and towards the user,
//   set_button(pressed), force() in N, violation()
template <class Mock>
class DriverBench {
 public:
  DriverBench() : DriverBench([] {}) {}

  // Opens the bench; `prepare` configures the mock before the device is opened.
  template <class Prepare>
  explicit DriverBench(Prepare prepare)
      : segment(std::move(*scene::SharedSegment::create(paper_model(), 0))), renderer(segment.renderer_side()) {
    Mock::reset();
    Mock::set_position(0, kContactMm + kTopMm, 0);
    prepare();
    device = std::move(*Mock::open(clock));
    loop = std::move(*haptics::ServoLoop::create(segment, *device, {}));
    renderer.store(scene::Selection{.material = kMica, .revision = 1});
  }

  ~DriverBench() {
    device.reset();
    EXPECT_EQ(Mock::violation(), nullptr) << Mock::violation();
  }
  DriverBench(const DriverBench&) = delete;
  DriverBench& operator=(const DriverBench&) = delete;

  void driver_tick() {
    clock.time_ns += kPeriodNs;
    Mock::tick(*device, clock.time_ns);
    const double before = force_n;
    force_n = felt();
    largest_force_n = std::max(largest_force_n, force_n);
    largest_step_n = std::max(largest_step_n, std::abs(force_n - before));
  }

  void servo_tick() {
    renderer.store(scene::RendererHeartbeat{.time_ns = clock.now_ns(), .frame = ++frame});
    loop->tick(clock.now_ns(), 0);
    while (renderer.pop_sample()) {
    }
    while (const auto event = renderer.pop_event()) events.push_back(*event);
  }

  void tick() {
    driver_tick();
    servo_tick();
    if (const auto line = device->supervise()) log.push_back(*line);
  }

  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) tick();
  }

  // Moves straight to this height above the contact point, at 0.1 m/s.
  void move_to(double height_mm) {
    while (std::abs(height_mm - height_mm_) > 1e-9) {
      height_mm_ += std::clamp(height_mm - height_mm_, -0.1, 0.1);
      Mock::set_position(0, kContactMm + height_mm_, 0);
      tick();
    }
  }

  void press_turn_on() {
    Mock::set_button(true);
    run(20);
    Mock::set_button(false);
    run(20);
  }

  void arm() {
    run(300);
    press_turn_on();
    run(600);
    ASSERT_EQ(state().servo_state, scene::ServoState::Running);
  }

  // Makes the tip hang on mica and pull the hand down with more than half a newton.
  void hold_attached() {
    arm();
    move_to(-5);
    move_to(25);
    run(50);
    ASSERT_EQ(state().phase, physics::Phase::Attached);
    ASSERT_GT(felt(), 0.5);
  }

  static double felt() {
    const std::array<double, 3> f = Mock::force();
    return std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
  }

  scene::TipState state() { return *renderer.tip_state(); }
  typename Mock::Health health() const { return device->health(clock.now_ns()); }

  static constexpr std::int64_t kPeriodNs = 1'000'000;
  static constexpr double kContactMm = Mock::kContactMm;
  static constexpr double kTopMm = 60;

  ManualClock clock;
  scene::SharedSegment segment;
  scene::RendererSide renderer;
  std::unique_ptr<typename Mock::Device> device;
  std::unique_ptr<haptics::ServoLoop> loop;
  std::vector<scene::TipEvent> events;
  std::vector<std::string> log;
  std::uint64_t frame = 0;
  double force_n = 0;
  double largest_force_n = 0;
  double largest_step_n = 0;

 private:
  double height_mm_ = kTopMm;
};

}  // namespace afm::test
