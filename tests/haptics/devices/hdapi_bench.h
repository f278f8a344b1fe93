// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/clock.h"
#include "devices/hdapi_device.h"
#include "haptics/servo_loop.h"
#include "mock_control.h"
#include "scene/shared/shared_segment.h"
#include "support/paper_model.h"
#include "support/places.h"

namespace afm::test {

class ManualClock final : public core::Clock {
 public:
  std::int64_t now_ns() const noexcept override { return time_ns.load(); }
  std::atomic<std::int64_t> time_ns{1'000'000'000};
};

// The servo and the mock's stylus, in time advanced only by tick(). No person holds the stylus: it keeps its position.
class HdapiBench {
 public:
  HdapiBench() : HdapiBench([] {}) {}

  // `prepare` shapes the mock before the device is opened.
  template <class Prepare>
  explicit HdapiBench(Prepare prepare)
      : segment(std::move(*scene::SharedSegment::create(paper_model(), 0))), renderer(segment.renderer_side()) {
    mock_hd_reset();
    mock_hd_set_position(0, kContactMm + kTopMm, 0);
    prepare();
    device = std::move(*haptics::HdapiDevice::open(*haptics::load_hdapi(afm::support::mock_hd()).functions, clock, "",
                                                   haptics::HdapiDevice::Supervision::Caller));
    loop = std::move(*haptics::ServoLoop::create(segment, *device, {}));
    renderer.store(scene::Selection{.material = kMica, .revision = 1});
  }

  ~HdapiBench() {
    device.reset();
    EXPECT_EQ(mock_hd_violation(), nullptr) << mock_hd_violation();
  }
  HdapiBench(const HdapiBench&) = delete;
  HdapiBench& operator=(const HdapiBench&) = delete;

  void driver_tick() {
    clock.time_ns += kPeriodNs;
    mock_hd_tick();
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

  // Straight to this height above the contact point, at 0.1 m/s.
  void move_to(double height_mm) {
    while (std::abs(height_mm - height_mm_) > 1e-9) {
      height_mm_ += std::clamp(height_mm - height_mm_, -0.1, 0.1);
      mock_hd_set_position(0, kContactMm + height_mm_, 0);
      tick();
    }
  }

  void press_turn_on() {
    mock_hd_set_buttons(1);
    run(20);
    mock_hd_set_buttons(0);
    run(20);
  }

  void arm() {
    run(300);
    press_turn_on();
    run(600);
    ASSERT_EQ(state().servo_state, scene::ServoState::Running);
  }

  // The tip hangs on mica and pulls the hand down with more than half a newton.
  void hold_attached() {
    arm();
    move_to(-5);
    move_to(25);
    run(50);
    ASSERT_EQ(state().phase, physics::Phase::Attached);
    ASSERT_GT(felt(), 0.5);
  }

  static double felt() {
    double f[3];
    mock_hd_force(f);
    return std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
  }

  scene::TipState state() { return *renderer.tip_state(); }
  haptics::HdapiHealth health() const { return device->health(clock.now_ns()); }

  static constexpr std::int64_t kPeriodNs = 1'000'000;
  static constexpr double kContactMm = -20;  // a third of the mock's workspace of 120 mm
  static constexpr double kTopMm = 60;

  ManualClock clock;
  scene::SharedSegment segment;
  scene::RendererSide renderer;
  std::unique_ptr<haptics::HdapiDevice> device;
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
