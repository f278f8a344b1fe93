// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "core/result.h"
#include "exhibit/lesson/lesson_prompt.h"
#include "physics/normal_generator.h"
#include "scene/shared/particle_blocks.h"
#include "scene/shared/soft_blocks.h"

namespace afm::curves {
struct SampleModel;
}
namespace afm::scene {
struct ParticleSet;
}

namespace afm::exhibit {

class LessonRun;

// Servo, its device, and the segment between servo and hand.
struct SimulatedServo;

// The hand of a simulated student who pushes particles or writes into a soft sample: the servo's own code moves them,
// in simulated time. The student sees them 0.25 s late, and trembles by 0.3 mm in the root mean square. Repeatable for
// a seed on the same build. One thread.
class SimulatedHand {
 public:
  // Creates the hand for this set, which must outlive it. Fails if the servo cannot render the set or the sample.
  static core::Result<std::unique_ptr<SimulatedHand>> create(const curves::SampleModel& sample,
                                                             const scene::ParticleSet& set, std::uint64_t seed);
  virtual ~SimulatedHand();

  // Takes the current step of the run, a push or lines, to its end; advances `now_s`, the lesson's time.
  // Failed if that takes more than ten minutes.
  core::Result<void> take_step(LessonRun& run, double& now_s);

 protected:
  static constexpr double kCommandS = 0.02;      // interval between two commands of the hand
  static constexpr double kSeenAfterS = 0.25;    // delay of the student's sight
  static constexpr double kDrawMPerS = 6e-3;     // speed of the hand on the sample
  static constexpr double kWayMPerS = 60e-3;     // speed of the hand above the sample
  static constexpr double kSteerPerS = 2.0;      // fraction of the seen error that the hand corrects per second
  static constexpr std::size_t kSeenAfter = 13;  // number of the hand's commands in kSeenAfterS

  SimulatedHand(const scene::ParticleSet& set, std::unique_ptr<SimulatedServo>&& servo, std::uint64_t seed);

  // Makes one more try, or rests if there is nothing to do.
  virtual void attempt(const LessonPrompt& prompt) = 0;

  bool goes_on() const;
  LessonPrompt prompt() const;  // current prompt
  double noise() { return normal_(); }
  void put_back();  // makes the servo put everything back, then arms again
  void rest(double seconds);
  void go(const glm::dvec2& to_m, double height_m, double m_per_s);  // target, height and speed in metres of the hand
  void step(const glm::dvec2& to_m, double height_m);
  void lift() { go(at_m_, high_m_, kWayMPerS); }

  const scene::ParticleSet& set() const { return set_; }
  const std::vector<scene::ParticlePage>& pages() const { return pages_; }  // newest pages
  const scene::TipPush& push() const { return push_; }                      // newest push
  double m_per_m() const { return m_per_m_; }                               // scale of the hand
  double high_m() const { return high_m_; }                                 // height above everything
  const glm::dvec2& at_m() const { return at_m_; }                          // intended position of the hand
  double height_m() const { return height_m_; }

 private:
  core::Result<void> begin();
  void arm();
  void select(bool release);
  void aim(const glm::dvec2& place_m, double height_m, double seconds, bool pressed = false);
  void tick(int count);
  void see();

  const scene::ParticleSet& set_;
  std::unique_ptr<SimulatedServo> servo_;
  std::vector<scene::ParticlePage> pages_;
  std::vector<scene::MarkTile> tiles_;  // newest tiles
  scene::TipPush push_;
  physics::NormalGenerator normal_;
  double m_per_m_ = 0, high_m_ = 0;
  std::int64_t now_ns_ = 1'000'000'000;
  int ticks_ = 0;
  std::uint32_t selection_ = 0, script_ = 0, put_back_ = 0;
  std::uint64_t frame_ = 0;
  glm::dvec2 at_m_{0.0}, tremor_m_{0.0};  // intended position, and the error due to tremor
  double height_m_ = 0;
  LessonRun* run_ = nullptr;  // run of the current take_step(); null otherwise
  LessonPrompt taken_;        // step of that run
  double now_s_ = 0;
};

}  // namespace afm::exhibit
