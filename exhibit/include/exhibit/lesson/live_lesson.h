// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "curves/sample_model.h"
#include "exhibit/lesson/data_set.h"
#include "exhibit/lesson/hand_answer.h"
#include "exhibit/lesson/instructor_page.h"
#include "exhibit/lesson/lesson.h"
#include "exhibit/lesson/lesson_panel.h"
#include "exhibit/lesson/lesson_run.h"
#include "exhibit/words/phrases.h"

namespace afm::core {
class Clock;
}
namespace afm::servo {
class ServoClient;
}

namespace afm::exhibit {

// A lesson at the live window: its prompts, the person's answers, the sample under the tip, and the data that are kept.
// Main thread only.
class LiveLesson {
 public:
  // `study`: where to store results; empty: nothing is kept and no consent is requested. Lesson, samples, phrases and
  // clock must outlive the object.
  LiveLesson(const Lesson& lesson, const std::vector<curves::SampleModel>& samples, const Phrases& phrases,
             const std::optional<DataSetEntry>& study, const core::Clock& clock);

  // Call once a frame.
  void update();

  const LessonPrompt& prompt() const { return prompt_; }
  const Lesson& lesson() const { return lesson_; }
  bool over() const { return prompt_.wants == LessonPrompt::Wants::Nothing; }

  // True if keys and swatches choose a sample: in free exploration of several.
  bool chooses_sample() const;

  void number(std::size_t number);  // handles keys 1 to 9; `number` counts from 0
  void press(const LessonTarget& target);
  void enter();
  void step(int steps);  // moves the mark on a scale
  void skip();
  void try_again();
  void next();  // continues as Enter does; for the instructor
  void stop();  // ends the lesson; for the instructor

  // Call once a frame if a person moves the hand. The height moves the mark; Turn-On answers or continues, unless the
  // lesson waits for a cycle.
  void hand_moved(double height_m, std::uint64_t presses);
  bool takes_hand() const;  // true: the hand gives answers, so it needs no force

  // The marked answer, if the mark has moved since the last call.
  std::optional<std::string> newly_marked();

  std::vector<LessonTarget> targets() const { return lesson_targets(prompt_, mark_.marked(), phrases_); }
  render::DataPanel panel() const { return lesson_panel(prompt_, phrases_); }

  // Text to speak before the guidance when the prompt is new; empty otherwise.
  std::string speech() const { return lesson_speech(prompt_, phrases_); }

  // The page's state except that of the hand.
  InstructorState instructor_state() const;

  // Records in the kept data that sound was requested but is no longer available. Call once a frame.
  void sound_is_lost();

  // True if the current prompt allows the scene on the wall, tones and the force.
  bool shows_scene() const;
  bool has_tones() const;
  bool has_force() const;

  // Puts the requested sample under the tip. Lays a blind sample again for each cycle, even the same one, so that the
  // pause does not reveal whether it has changed. Call once a frame.
  void lay_sample(servo::ServoClient& servo);
  void forget_laid() { laid_.reset(); }  // after a new servo or a restart of the wall

  // Follows the force on the hand: call with every sample of the servo, in order with its events.
  void felt(const scene::TipSample& sample, const servo::ServoClient& servo);

  // Handles an event of the tip on the servo's current sample: a jump, or an effect on a particle.
  void happened(const scene::TipEvent& event, const servo::ServoClient& servo);

  // Call once a frame with the newest particles or marks, after the servo's events and samples.
  void look(const servo::ServoClient& servo);

  // True if all particles must be put back before the current push, or all marks removed before lines are written. Once
  // there is no force, send the request whenever the second function returns true, at most once a second.
  bool needs_particles_back() const { return prompt_.put_back; }
  bool orders_particles_back();

  // Stops the running lesson when the window ends. Returns the error if results could not be stored.
  core::Result<void> finish();

 private:
  struct Laid {
    std::size_t task = 0;
    std::uint32_t cycle = 0;
    bool operator==(const Laid&) const = default;
  };

  double now_s() const;
  void acted();
  core::Result<void> begin_data();
  core::Result<void> keep(const TrialRow& row);

  const Lesson& lesson_;
  const std::vector<curves::SampleModel>& samples_;
  const Phrases& phrases_;
  std::optional<DataSetEntry> study_;
  const core::Clock& clock_;
  std::optional<DataSet> data_;
  std::optional<core::Error> error_;
  bool sound_lost_noted_ = false;
  std::size_t right_ = 0, judged_ = 0;  // numbers of right answers and of counted trials
  LessonRun run_;
  LessonPrompt prompt_;
  HandAnswer mark_;
  std::optional<std::size_t> told_mark_;
  std::optional<Laid> laid_;
  std::optional<double> put_back_s_;  // time of the newest request to put the particles back
  std::uint32_t edit_ = 0;            // revision of the variant's edit; 0: parameters as loaded
  std::vector<bool> varied_;          // true for materials with changed parameters
};

}  // namespace afm::exhibit
