// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
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

// An observer whose abilities are known (equal-variance Gaussian): what a report of its data must find again.
struct Abilities {
  double d_prime = 1.5;         // between two materials
  double weber_fraction = 0.1;  // difference of two pull-offs of which the stronger one is named in 75 of 100 trials
  double bias = 0;              // towards the first answer, in the units of d'
};

// What follows "sim:" on the command line: "7", "7,d-prime=2,weber=0.08,bias=0.3".
struct SimulatedParticipant {
  std::uint64_t seed = 0;
  Abilities abilities{};

  static core::Result<SimulatedParticipant> parse(std::string_view text);
  std::string code() const;  // six capital letters, drawn from the seed
  std::string json() const;  // of seed and abilities
};

// Goes through a lesson to its end in simulated time: feels each cycle with the real law of force on the lesson's scale
// and answers by what it felt. The same for a seed, on one build. One thread.
class SimulatedStudent {
 public:
  SimulatedStudent(const SimulatedParticipant& participant, const Lesson& lesson,
                   std::span<const curves::SampleModel> samples);

  // Fails if the scale does not suit the simulated device, or the run as LessonRun::error() says.
  core::Result<void> take(LessonRun& run);

 private:
  core::Result<void> feel(LessonRun& run, const LessonPrompt& prompt);
  std::size_t choose(const LessonPrompt& prompt);
  std::size_t rate(const LessonPrompt& prompt);  // of an item, which has no right answer
  std::size_t stronger_of_two();
  std::size_t identify(const LessonPrompt& prompt);

  Abilities abilities_;
  scene::ScaleMode scale_;
  std::span<const curves::SampleModel> samples_;
  LessonRandom random_;
  physics::NormalGenerator normal_;
  haptics::CommonScale common_;
  double now_s_ = 0;
  double felt_n_[2] = {0, 0};  // on the hand: the last two cycles, the newer one behind
};

}  // namespace afm::exhibit
