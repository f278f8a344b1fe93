// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/frame_budget.h"
#include "app/frame_builder.h"
#include "app/guidance.h"
#include "app/live_servo.h"
#include "app/report.h"
#include "app/servo_link.h"
#include "app/session_recorder.h"
#include "app/simulated_person.h"
#include "app/stage_setup.h"
#include "core/clock.h"
#include "render/renderer.h"

namespace afm::app {

// What is felt, in order: every material, and each once more for every one of its variations, which are other
// parameters of the same sample.
struct DemoPlan {
  std::vector<FeltMaterial> materials;
  std::vector<std::vector<FeltMaterial>> variations;  // one list per material
  std::vector<scene::SharedMeasuredCurve> curves;     // of measured materials
  double frame_budget_ms = 0;                         // as --frame-budget
  scene::ScaleMode scale = scene::ScaleMode::Fit;
};

// One live run of the paper's procedure on every material: the simulated person's wand and hand, the servo, and the
// renderer, each doing what it does for a real person. One thread.
class Demonstration {
 public:
  using Progress = std::function<void(const std::string&)>;

  // `chosen` is called once a frame is drawn in which the ray chooses for the first time. Everything must outlive it.
  Demonstration(const Stage& stage, const DemoPlan& plan, render::Renderer& renderer, ServoLink& servo,
                const core::Clock& clock, const HandPath& path, std::function<void()> chosen);

  // Until every cycle is done. Fails when the servo dies, when something that must happen does not, or on SIGINT or
  // SIGTERM. Fills sessions, variations, frame times and the servo's timing of the result.
  core::Result<void> run(DemoResult& result, const Progress& progress);

 private:
  core::Result<RecordedSession> feel(std::size_t material, DemoResult& result, const Progress& progress);
  core::Result<RecordedSession> feel_variation(std::size_t material, const FeltMaterial& variation, DemoResult& result,
                                               const Progress& progress);
  core::Result<void> keep_patience(const std::string& title, double step_seconds, const DemoResult& result) const;
  void wait_for_renderer();
  core::Result<void> step(DemoResult& result);
  core::Result<void> take_news(std::int64_t now_ns);
  void forget_cycle(std::size_t material);
  Moment moment(const input::WandState& wand, const input::Selector::Result& pointing) const;
  Hint hint() const;

  const WallScene& wall_scene_;
  const Guidance& guidance_;
  const DemoPlan& plan_;
  std::vector<FeltMaterial> materials_;  // as they are felt now
  FrameBuilder frames_;
  render::Renderer& renderer_;
  ServoLink& servo_;
  const core::Clock& clock_;
  std::optional<FrameBudget> budget_;
  HandPath path_;
  std::function<void()> chosen_;  // empty once it was called
  SimulatedPerson person_;
  input::Selector selector_;
  std::vector<input::Target> targets_;
  glm::dvec3 between_eyes_m_;

  SessionRecorder recorder_;
  double deepest_z_m_ = 0;
  TipStream stream_;
  std::vector<CycleCurve> curves_;
};

// The moment of a session at `time_ns`, as the live wall showed it; `curves` has one entry per material.
Moment moment_of(const RecordedSession& session, std::size_t material, std::int64_t time_ns,
                 std::span<const CycleCurve> curves);

}  // namespace afm::app
