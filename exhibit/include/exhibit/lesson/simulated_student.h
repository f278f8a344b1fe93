// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/result.h"
#include "curves/sample_model.h"
#include "exhibit/lesson/lesson.h"
#include "exhibit/lesson/lesson_random.h"
#include "exhibit/lesson/lesson_run.h"
#include "haptics/scaling.h"
#include "physics/normal_generator.h"

namespace afm::exhibit {

class SimulatedHand;

// A simulated observer with known abilities (equal-variance Gaussian), which a report of its data must recover.
struct Abilities {
  double d_prime = 1.5;         // sensitivity to the difference of two materials
  double weber_fraction = 0.1;  // relative difference of two pull-offs at which 75 of 100 answers are right
  double bias = 0;              // bias towards the first answer, in units of d'
};

// Parsed from the text after "sim:" on the command line: "7", "7,d-prime=2,weber=0.08,bias=0.3".
struct SimulatedParticipant {
  std::uint64_t seed = 0;
  Abilities abilities{};

  static core::Result<SimulatedParticipant> parse(std::string_view text);
  std::string code() const;  // participant's code, six capital letters derived from the seed
  std::string json() const;  // JSON with seed and abilities
};

// Takes a whole lesson in simulated time: feels each cycle with the real force law at the lesson's scale and answers
// from the felt forces. Pushes particles and writes lines with a delay of 0.25 s and a tremor of 0.3 mm. Repeatable for
// a seed on the same build. One thread.
class SimulatedStudent {
 public:
  // Lesson and samples must outlive the object.
  SimulatedStudent(const SimulatedParticipant& participant, const Lesson& lesson,
                   std::span<const curves::SampleModel> samples);
  ~SimulatedStudent();

  // Fails if the scale does not suit the simulated device, or with LessonRun::error().
  core::Result<void> take(LessonRun& run);

 private:
  core::Result<void> feel(LessonRun& run, const LessonPrompt& prompt);
  core::Result<void> take_step(LessonRun& run);  // takes a step with a push, or with lines
  std::size_t choose(const LessonPrompt& prompt);
  std::size_t rate(const LessonPrompt& prompt);  // rates an item that has no right answer
  std::size_t stronger_of_two();
  std::size_t identify(const LessonPrompt& prompt);

  Abilities abilities_;
  std::uint64_t seed_;
  const scene::ParticleSet* particles_;  // particles of the lesson; null: none
  scene::ScaleMode scale_;
  std::span<const curves::SampleModel> samples_;
  LessonRandom random_;
  physics::NormalGenerator normal_;
  haptics::CommonScale common_;
  std::unique_ptr<SimulatedHand> hand_;  // hand that pushes and writes; null before the first push or line
  double now_s_ = 0;
  double felt_n_[2] = {0, 0};  // forces on the hand in the last two cycles, the newer one second
};

}  // namespace afm::exhibit
