// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "haptics/servo_loop.h"
#include "haptics/simulated_device.h"
#include "physics/contact.h"
#include "scene/shared/shared_segment.h"
#include "support/paper_model.h"

namespace afm::test {

// Value of a result, or an exception that fails the test with the error's line.
template <class T>
T required(core::Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}

// Events of a cycle with one of the paper's materials, by its equations.
inline physics::ApproachRetractEvents calculated(std::int32_t material) {
  return physics::approach_retract_events(paper_model().materials[static_cast<std::size_t>(material)].contact);
}

// Contact model as built by the servo, with its own scale; `drawn` null for a plane. Throws like required().
inline std::unique_ptr<haptics::ContactModel> model_of(const scene::SharedContact& material,
                                                       const scene::FeltHeights& drawn = {},
                                                       std::int64_t period_ns = 1'000'000) {
  const auto omni = haptics::omni_like("hand");
  const auto tables = required(haptics::build_tables(material, {}));
  const auto common = required(haptics::Scaling::common_scale(std::vector{tables}, omni));
  return required(haptics::ContactModel::create(material, 0, tables, drawn, common, omni, period_ns));
}

// The servo, the simulated hand and the renderer's side of the segment, in time advanced only by tick().
class ServoBench {
 public:
  explicit ServoBench(const scene::SharedModel& model = paper_model(), double rate_hz = 1000.0,
                      const haptics::DeviceFlaws& flaws = {}, double max_force_n = HUGE_VAL,
                      const scene::Topography& topography = {})
      : segment(required(scene::SharedSegment::create(model, 0, topography))),
        renderer(segment.renderer_side()),
        device(glm::dvec3(0.0, kTop, 0.0), {}, flaws),
        loop(required(haptics::ServoLoop::create(segment, device, {.rate_hz = rate_hz, .max_force_n = max_force_n}))) {}

  // Runs one tick `late_ns` after its time.
  void tick(std::int64_t late_ns = 0) {
    if (heartbeats) {
      renderer.store(scene::RendererHeartbeat{.time_ns = now_ns,
                                              .frame = ++frame,
                                              .unseen = unseen ? 1U : 0U,
                                              .take_back = taken_back,
                                              .put_back = put_back});
    }
    now_ns += loop->period_ns() + late_ns;
    loop->tick(now_ns, static_cast<std::uint32_t>(late_ns / 1000));
    while (const auto sample = renderer.pop_sample()) samples.push_back(*sample);
    while (const auto event = renderer.pop_event()) events.push_back(*event);
  }

  void run(double seconds) {
    for (std::int64_t end_ns = now_ns + std::llround(1e9 * seconds); now_ns < end_ns;) tick();
  }

  scene::TipState state() { return *renderer.tip_state(); }
  double hand_force_n() {
    const auto force = state().hand.force_n;
    return std::sqrt(force[0] * force[0] + force[1] * force[1] + force[2] * force[2]);
  }

  void choose(std::int32_t material, scene::ScaleMode mode = scene::ScaleMode::Fit) {
    renderer.store(
        scene::Selection{.material = material, .revision = ++selection, .scale_mode = mode, .settings = settings});
    loop->edits().build();
  }

  // Sends other parameters for a material, and another curve if it has one, and runs the builder.
  void edit(std::int32_t material, const scene::SharedContact& parameters,
            const scene::SharedMeasuredCurve& curve = {}) {
    renderer.store(scene::MaterialEdit{.material = parameters, .revision = ++edits, .curve = curve},
                   static_cast<std::uint32_t>(material));
    loop->edits().build();
  }

  // Aims the hand at this height above the contact point; the button is `pressed` from then on.
  void aim(double height_m, double seconds, bool pressed = false) {
    renderer.store(scene::HandScript{.target_m = {0.0, height_m, 0.0},
                                     .duration_s = seconds,
                                     .revision = ++script,
                                     .turn_on_pressed = pressed ? 1U : 0U});
  }

  // Aims, and waits until the path has been played.
  void move(double height_m, double seconds) {
    aim(height_m, seconds);
    while (state_or_default().acknowledged.hand_script != script) tick();
  }

  // The paper's procedure: choose, lift, press Turn-On; returns in Running with the button released.
  void arm(std::int32_t material, scene::ScaleMode mode = scene::ScaleMode::Fit) {
    choose(material, mode);
    move(kTop, 0.3);
    run(1.0);
    aim(kTop, 0.0, true);
    run(0.1);
    aim(kTop, 0.0);
    run(0.6);
    ASSERT_EQ(state().servo_state, scene::ServoState::Running);
  }

  // Holds the tip on the sample in the middle of the adhesive stroke.
  void hold_attached(std::int32_t material) {
    arm(material);
    move(-0.010, 0.5);
    move(0.025, 0.5);
    run(0.5);
    ASSERT_EQ(state().phase, physics::Phase::Attached);
    ASSERT_GT(hand_force_n(), 0.5);
  }

  static constexpr double kTop = 0.060;

  scene::SharedSegment segment;
  scene::RendererSide renderer;
  haptics::SimulatedDevice device;
  std::unique_ptr<haptics::ServoLoop> loop;
  std::vector<scene::TipSample> samples;
  std::vector<scene::TipEvent> events;
  std::int64_t now_ns = 1'000'000'000;
  bool heartbeats = true;
  bool unseen = false;
  scene::PushSettings settings{};  // settings sent with every choice
  std::uint32_t taken_back = 0;    // numbers of requests to take a push back, and to put all particles back
  std::uint32_t put_back = 0;
  std::uint64_t frame = 0;
  std::uint32_t selection = 0;
  std::uint32_t edits = 0;
  std::uint32_t script = 0;

 private:
  scene::TipState state_or_default() { return renderer.tip_state().value_or(scene::TipState{}); }
};

}  // namespace afm::test
