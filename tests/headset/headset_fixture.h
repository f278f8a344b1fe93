// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/clock.h"
#include "render/headset.h"
#include "stand_in.h"
#include "support/places.h"
#include "support/test_scene.h"

namespace afm::test {

class HandClock final : public core::Clock {
 public:
  std::int64_t now_ns() const noexcept override { return now_ns_; }
  void go_on(std::int64_t by_ns) { now_ns_ += by_ns; }

 private:
  std::int64_t now_ns_ = 1'000'000'000;
};

// The test scene in a headset of the stand-in runtime, under validation and synchronisation validation.
class HeadsetTest : public testing::Test {
 protected:
  HeadsetTest() {
    ::setenv("XR_RUNTIME_JSON", support::openxr_stand_in().c_str(), 1);
    ::setenv("XR_LOADER_DEBUG", "none", 1);
    stand_in::stand_in().begin_again();
  }
  ~HeadsetTest() override {
    disconnect();
    EXPECT_THAT(stand_in::stand_in().log.faults, testing::IsEmpty());
  }

  template <class T>
  static T must(core::Result<T> made) {
    if (!made) throw std::runtime_error(made.error().message);
    return std::move(*made);
  }

  void connect() {
    runtime_ = must(render::HeadsetRuntime::connect(support::openxr_stand_in()));
    context_.emplace(must(render::Context::open({.validation = validation_, .runtime = runtime_.get()})));
    const glm::uvec2 eye_px = runtime_->eye_px();
    renderer_.emplace(must(render::Renderer::create(*context_, scene_.scene,
                                                    {.eye_width = eye_px.x,
                                                     .eye_height = eye_px.y,
                                                     .panel_texels_per_m = kTexelsPerM,
                                                     .panel_contrast = kContrast})));
    headset_ = must(render::Headset::create(*runtime_, *context_, *renderer_, room_from_floor_, clock_));
  }

  void disconnect() {
    headset_.reset();
    renderer_.reset();
    if (context_) {
      for (const auto& message : context_->take_validation_messages()) ADD_FAILURE() << message;
    }
    context_.reset();
    runtime_.reset();
  }

  // Runs a turn in which the clock advances during every wait.
  render::Headset::Turn turn() {
    return headset_->next_turn([this] { wait_on(); });
  }

  // Draws the next frame requested by the runtime; empty if it requests none in 20 turns.
  std::optional<std::array<render::HeadsetEye, 2>> draw_next() {
    for (int i = 0; i < 20; ++i) {
      if (turn() != render::Headset::Turn::Frame) continue;
      const auto eyes = headset_->locate_eyes([this] { wait_on(); });
      if (eyes) {
        frame_.eyes = {(*eyes)[0].view, (*eyes)[1].view};
        frame_.panels_apart = headset_->most_panels();
        renderer_->render(frame_);
      }
      shown_ = headset_->show();
      return eyes;
    }
    return std::nullopt;
  }

  void wait_on() {
    ++beats_;
    clock_.go_on(5'000'000);
    if (beats_ == lends_after_beats_) script().lends = true;
  }

  std::string messages() {
    std::string all;
    for (const std::string& line : headset_->take_messages()) all += line + "\n";
    return all;
  }

  stand_in::Script& script() { return stand_in::stand_in().script; }
  stand_in::Log& log() { return stand_in::stand_in().log; }

  static constexpr double kTexelsPerM = 320.0;
  static constexpr auto kContrast = render::PanelContrast::Opaque;
  render::Validation validation_ = render::Validation::On;
  HandClock clock_;
  int beats_ = 0;
  int lends_after_beats_ = 0;  // number of heartbeats before images are lent; 0: never
  bool shown_ = false;         // true: newest frame of draw_next() shown
  TestScene scene_ = make_test_scene();
  render::FrameState frame_ = full_frame(scene_);
  scene::HeadPose room_from_floor_{.position_m = {0.0, -1.6, 2.5}};  // the test scene's wall is before its origin
  std::unique_ptr<render::HeadsetRuntime> runtime_;
  std::optional<render::Context> context_;
  std::optional<render::Renderer> renderer_;
  std::unique_ptr<render::Headset> headset_;
};

}  // namespace afm::test
