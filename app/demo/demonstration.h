// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/options/dynamic_resolution.h"
#include "core/clock.h"
#include "curves/sample_model.h"
#include "exhibit/state/cycle_curve.h"
#include "input/selection.h"
#include "input/simulated_person.h"
#include "physics/curve_analysis.h"

namespace afm::exhibit {
struct DemoResult;
class FrameBuilder;
enum class Hint;
struct Moment;
class Phrases;
struct Stage;
class WallScene;
}  // namespace afm::exhibit
namespace afm::render {
class Renderer;
}
namespace afm::servo {
struct RecordedSession;
class ServoClient;
class SessionRecorder;
class TipStream;
}  // namespace afm::servo

namespace afm::app {

// Cycles of the demonstration, in order: every material, then the same material with the parameters of each variation.
struct DemoPlan {
  std::vector<curves::SampleModel> materials;
  std::vector<std::vector<curves::SampleModel>> variations;  // one list per material
  std::vector<scene::SharedMeasuredCurve> curves;            // curves of measured materials
  std::optional<physics::CurveFeatures> recorded;            // analysis of the measured material
  double frame_budget_ms = 0;                                // time per frame; 0: no budget
  scene::ScaleMode scale = scene::ScaleMode::Fit;
};

// One live run of the paper's procedure on every material: the simulated person's wand and hand, the servo, and the
// renderer, each as for a real person. One thread.
class Demonstration {
 public:
  using Progress = std::function<void(const std::string&)>;

  // Calls `chosen` after the first frame in which the ray selects a sample. All arguments must outlive the object.
  Demonstration(const exhibit::Stage& stage, const DemoPlan& plan, render::Renderer& renderer,
                servo::ServoClient& servo, const core::Clock& clock, const input::HandPath& path,
                std::function<void()> chosen);
  ~Demonstration();

  // Runs until all cycles are done. Fails if the servo dies or an expected event does not occur. Fills the sessions,
  // variations, frame times and servo timing of the result.
  core::Result<void> run(exhibit::DemoResult& result, const Progress& progress);

 private:
  core::Result<servo::RecordedSession> feel(std::size_t material, exhibit::DemoResult& result,
                                            const Progress& progress);
  core::Result<servo::RecordedSession> feel_variation(std::size_t material, const curves::SampleModel& variation,
                                                      exhibit::DemoResult& result, const Progress& progress);
  core::Result<void> keep_patience(const std::string& title, double step_seconds,
                                   const exhibit::DemoResult& result) const;
  core::Result<void> step(exhibit::DemoResult& result);
  core::Result<void> consume_update(std::int64_t now_ns);
  void forget_cycle(std::size_t material);
  exhibit::Moment moment(const input::WandState& wand, const input::Selector::Result& pointing) const;
  exhibit::Hint hint() const;

  const exhibit::WallScene& wall_scene_;
  const exhibit::Phrases& phrases_;
  const DemoPlan& plan_;
  std::vector<curves::SampleModel> materials_;  // materials as currently felt
  std::unique_ptr<exhibit::FrameBuilder> frames_;
  render::Renderer& renderer_;
  servo::ServoClient& servo_;
  const core::Clock& clock_;
  std::optional<DynamicResolution> budget_;
  input::HandPath path_;
  std::function<void()> chosen_;  // callback for the first selection; empty after the call
  input::SimulatedPerson person_;
  input::Selector selector_;
  std::vector<input::Target> targets_;
  glm::dvec3 between_eyes_m_;

  std::unique_ptr<servo::SessionRecorder> recorder_;
  double deepest_z_m_ = 0;
  std::unique_ptr<servo::TipStream> stream_;
  std::vector<exhibit::CycleCurve> curves_;
};

}  // namespace afm::app
