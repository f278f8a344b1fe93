// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "curves/sample_model.h"
#include "exhibit/lesson/lesson.h"
#include "exhibit/lesson/lesson_prompt.h"
#include "exhibit/lesson/lesson_random.h"
#include "exhibit/lesson/trial_row.h"
#include "exhibit/words/phrases.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

class StepActivity;

// How a lesson ended.
enum class LessonEnd { Finished, Stopped, Withdrew };

// A lesson under way: what it asks for now, and what becomes of it. Time is the caller's, in seconds that never go
// back, so that a simulated participant needs no clock. Names the trials that are over to a sink. One thread.
//
// A criterion is decided by the servo's events alone: a cycle is a jump to contact and a jump off contact on the
// material that is asked for. After kMostLessonMinutes the lesson offers a break: before the next trial, or while
// nothing of one would be lost, also to somebody who does nothing. A trial that takes two more minutes begins again
// after the break.
class LessonRun {
 public:
  struct Setup {
    std::uint64_t seed = 0;    // of orders and stimuli
    std::size_t order = 0;     // row of the Williams design
    bool ask_consent = false;  // of a person
  };

  // Lesson, samples (lesson_samples(), in that order) and phrases must outlive it. The sink is not called before
  // consent() where that is asked for.
  LessonRun(const Lesson& lesson, std::span<const curves::SampleModel> samples, const Phrases& phrases,
            const Setup& setup, TrialSink sink, double now_s);
  ~LessonRun();
  LessonRun(const LessonRun&) = delete;
  LessonRun& operator=(const LessonRun&) = delete;

  // What is asked for at this time.
  LessonPrompt prompt(double now_s) const;

  // A jump of the tip, of the material and the variant that the prompt asks for.
  void happened(const scene::TipEvent& event, double now_s);

  // Offers a break that is due; in a lesson with a person, once a frame.
  void watch_time(double now_s);

  void go_on(double now_s);
  void answer(std::size_t answer, double now_s);  // one that the prompt has; others are ignored
  void skip(double now_s);                        // the rest of the step
  void reset(double now_s);                       // the trial under way begins again
  void stop();

  double elapsed_s(double now_s) const { return now_s - began_s_; }  // since it began, with the consent
  bool consented() const { return consented_; }
  std::optional<LessonEnd> end() const { return end_; }
  // A trial that could not be kept ends the lesson.
  const std::optional<core::Error>& error() const { return error_; }

 private:
  struct Task {
    std::size_t step = 0;
    std::optional<Condition> condition;
  };
  enum class Stage { Consent, Steps, Break };

  void plan(std::size_t order);
  void begin_task(double now_s);
  void follow(double now_s);  // after whatever happened
  bool offer_break_where_due(double now_s);
  core::Result<void> keep(TrialRow row);

  const Lesson& lesson_;
  std::span<const curves::SampleModel> samples_;
  const Phrases& phrases_;
  TrialSink sink_;
  LessonRandom random_;
  std::vector<Task> tasks_;
  std::size_t task_ = 0;
  std::unique_ptr<StepActivity> activity_;
  Stage stage_ = Stage::Steps;
  double began_s_ = 0;  // the lesson
  double step_began_s_ = 0;
  double stretch_began_s_ = 0;  // since the last break
  double break_answers_from_s_ = 0;
  bool consented_ = false;
  bool snapped_in_ = false;
  std::optional<LessonEnd> end_;
  std::optional<core::Error> error_;
};

}  // namespace afm::exhibit
