// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "core/result.h"
#include "exhibit/lesson/lesson_run.h"
#include "exhibit/lesson/push_plan.h"
#include "haptics/servo_loop.h"
#include "haptics/simulated_device.h"
#include "physics/normal_generator.h"
#include "scene/samples/particle_set.h"
#include "scene/shared/shared_segment.h"

namespace afm::curves {
struct SampleModel;
}

namespace afm::exhibit {

// The hand of a simulated student who pushes particles: the servo's own code moves them, in simulated time. The student
// sees them 0.25 s late, trembles by 0.3 mm in the root mean square, and steers towards the line from particle to
// target. Repeatable for a seed on the same build. One thread.
class SimulatedPusher {
 public:
  // `set` must outlive the object. Fails if the servo cannot render sample or particles.
  static core::Result<std::unique_ptr<SimulatedPusher>> create(const curves::SampleModel& sample,
                                                               const scene::ParticleSet& set, std::uint64_t seed);

  // Takes the step Push at which the run is to its end; `now_s` is the lesson's time, which it moves on. Failed if that
  // takes more than ten minutes.
  core::Result<void> push(LessonRun& run, double& now_s);

 private:
  SimulatedPusher(const scene::ParticleSet& set, scene::SharedSegment segment, std::uint64_t seed);

  core::Result<void> begin();
  void make_ready();  // with all particles at their start, and the force on
  void attempt(const PushPlan& plan);
  void bring(std::size_t particle, const glm::dvec2& to_m);
  void steer(std::size_t particle, const glm::dvec2& to_m);
  void slip_past(std::size_t particle);
  glm::dvec2 free_direction(std::size_t particle, double way_m) const;
  glm::dvec2 place(std::size_t particle) const;
  double radius_m(std::size_t particle) const;

  void arm();
  void select(bool release);
  void rest(double seconds);
  void go(const glm::dvec2& to_m, double height_m, double m_per_s);  // in metres of the hand
  void step(const glm::dvec2& to_m, double height_m);
  void aim(const glm::dvec2& place_m, double height_m, double seconds, bool pressed = false);
  void tick(int count);
  bool goes_on() const;

  const scene::ParticleSet& set_;
  std::vector<glm::dvec2> targets_m_;
  scene::SharedSegment segment_;
  scene::RendererSide renderer_;
  haptics::SimulatedDevice device_;
  std::unique_ptr<haptics::ServoLoop> loop_;
  std::vector<scene::ParticlePage> pages_;  // newest
  physics::NormalGenerator normal_;
  double m_per_m_ = 0, low_m_ = 0, high_m_ = 0;  // scale and heights of the hand
  std::int64_t now_ns_ = 1'000'000'000;
  int ticks_ = 0;
  std::uint32_t selection_ = 0, script_ = 0, put_back_ = 0;
  std::uint64_t frame_ = 0;
  glm::dvec2 at_m_{0.0}, tremor_m_{0.0};  // intended place, and the error of the tremor
  double height_m_ = 0;
  LessonRun* run_ = nullptr;  // only during push()
  std::size_t task_ = 0;
  double now_s_ = 0;
  std::optional<glm::dvec2> end_m_;  // where the particle of this step is to go
};

}  // namespace afm::exhibit
