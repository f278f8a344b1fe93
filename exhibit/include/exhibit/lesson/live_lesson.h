// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/clock.h"
#include "curves/sample_model.h"
#include "exhibit/lesson/data_set.h"
#include "exhibit/lesson/hand_answer.h"
#include "exhibit/lesson/instructor_page.h"
#include "exhibit/lesson/lesson.h"
#include "exhibit/lesson/lesson_panel.h"
#include "exhibit/lesson/lesson_run.h"
#include "exhibit/words/phrases.h"

namespace afm::servo {
class ServoClient;
}

namespace afm::exhibit {

// A lesson at the live window: what it asks for, the person's answers, the sample that it lays under the tip, and what
// is kept of it. Main thread.
class LiveLesson {
 public:
  // `study`: where results go; without one nothing is kept and nobody is asked. Lesson, samples, phrases and clock must
  // outlive it.
  LiveLesson(const Lesson& lesson, const std::vector<curves::SampleModel>& samples, const Phrases& phrases,
             const std::optional<DataSetEntry>& study, const core::Clock& clock);

  // Once a frame.
  void update();

  const LessonPrompt& prompt() const { return prompt_; }
  const Lesson& lesson() const { return lesson_; }
  bool over() const { return prompt_.wants == LessonPrompt::Wants::Nothing; }

  // Whether keys and swatches choose a sample: in free exploration of several.
  bool chooses_sample() const;

  void number(std::size_t number);  // keys 1 to 9, from 0
  void press(const LessonTarget& target);
  void enter();
  void step(int steps);  // of the mark of a scale
  void skip();
  void try_again();
  void next();  // of the instructor: goes on where the person would press Enter
  void stop();  // of the instructor: the lesson ends here

  // Once a frame, where a person moves the hand: its height moves the mark, and Turn-On answers or goes on, where the
  // lesson waits for no cycle.
  void hand_moved(double height_m, std::uint64_t presses);
  bool takes_hand() const;  // so that the hand needs no force

  // The answer under the mark, if that has moved since the last call.
  std::optional<std::string> newly_marked();

  std::vector<LessonTarget> targets() const { return lesson_targets(prompt_, mark_.marked(), phrases_); }
  render::DataPanel panel() const { return lesson_panel(prompt_, phrases_); }

  // What is to be spoken before the line of guidance, since the prompt is a new one.
  std::string speech() const { return lesson_speech(prompt_, phrases_); }

  // All of it but the hand.
  InstructorState instructor_state() const;

  // Sound was asked for, and there is none from now on: what is kept says so. Once a frame.
  void sound_is_lost();

  // What this prompt leaves a participant: the scene on the wall, tones, the force.
  bool shows_scene() const;
  bool has_tones() const;
  bool has_force() const;

  // Sees to it that the sample that is asked for gets under the tip; blind ones are laid anew for each cycle, so that
  // nobody knows by the pause whether it is another one. Once a frame.
  void lay_sample(servo::ServoClient& servo);
  void forget_laid() { laid_.reset(); }  // another servo runs, or everything begins again

  // A jump of the tip; `servo` says of which sample.
  void happened(const scene::TipEvent& event, const servo::ServoClient& servo);

  // The window ends: what is under way is stopped. The error of what could not be kept.
  core::Result<void> finish();

 private:
  struct Laid {
    std::size_t task = 0;
    std::uint32_t cycle = 0;
    bool operator==(const Laid&) const = default;
  };

  double now_s() const { return static_cast<double>(clock_.now_ns()) * 1e-9; }
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
  std::size_t right_ = 0, judged_ = 0;  // of the counted trials
  LessonRun run_;
  LessonPrompt prompt_;
  HandAnswer mark_;
  std::optional<std::size_t> told_mark_;
  std::optional<Laid> laid_;
  std::uint32_t edit_ = 0;    // of the variant under the tip; 0: as loaded
  std::vector<bool> varied_;  // materials whose parameters were changed
};

}  // namespace afm::exhibit
