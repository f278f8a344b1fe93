// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/frame_builder.h"
#include "app/live_servo.h"
#include "app/report.h"
#include "app/servo_link.h"
#include "app/simulated_person.h"
#include "core/clock.h"
#include "render/renderer.h"

namespace afm::app {

// One live run of the paper's procedure on every material: the simulated person's wand and hand, the servo, and the
// renderer, each doing what it does for a real person. One thread.
class Demonstration {
 public:
  using Progress = std::function<void(const std::string&)>;

  // Everything must outlive it.
  Demonstration(const WallScene& wall_scene, const scene::MaterialLibrary& materials, const FrameBuilder& frames,
                render::Renderer& renderer, ServoLink& servo, const core::Clock& clock, const HandPath& path);

  // Until every cycle is done. Fails when the servo dies, when something that must happen does not, or on SIGINT or
  // SIGTERM. Fills sessions, frame times and the servo's timing of the result.
  core::Result<void> run(DemoResult& result, const Progress& progress);

 private:
  core::Result<void> feel(std::size_t material, DemoResult& result, const Progress& progress);
  void wait_for_renderer();
  core::Result<void> step(DemoResult& result);
  core::Result<void> take_news(std::int64_t now_ns);
  void begin_session(std::size_t material);
  Moment moment(const input::WandState& wand, const input::Selector::Result& pointing) const;
  std::string guidance() const;

  const WallScene& wall_scene_;
  const scene::MaterialLibrary& materials_;
  const FrameBuilder& frames_;
  render::Renderer& renderer_;
  ServoLink& servo_;
  const core::Clock& clock_;
  HandPath path_;
  SimulatedPerson person_;
  input::Selector selector_;
  std::vector<input::Target> targets_;

  std::optional<std::size_t> current_;  // whose session is being recorded
  RecordedSession session_;
  double deepest_z_m_ = 0;
  TipStream stream_;
  std::vector<CycleCurve> curves_;
};

// The moment of a session at `time_ns`, as the live wall showed it; `curves` has one entry per material.
Moment moment_of(const RecordedSession& session, std::size_t material, std::int64_t time_ns,
                 std::span<const CycleCurve> curves);

}  // namespace afm::app
