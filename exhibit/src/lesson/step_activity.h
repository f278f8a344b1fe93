// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/result.h"
#include "curves/sample_model.h"
#include "exhibit/lesson/lesson.h"
#include "exhibit/lesson/lesson_prompt.h"
#include "exhibit/lesson/lesson_random.h"
#include "exhibit/lesson/trial_row.h"
#include "exhibit/words/phrases.h"

namespace afm::exhibit {

// What a step works with; all of it outlives the step.
struct StepContext {
  const LessonStep& step;
  std::span<const curves::SampleModel> samples;  // of the lesson
  const Phrases& phrases;
  LessonRandom& random;
  std::function<void(TrialRow)> keep;       // a trial that is over; step, kind and condition are filled in
  std::function<void(core::Error)> failed;  // what ends the lesson

  std::string words() const { return step.words.in(phrases[Phrase::Language]); }
};

// A step under way. What does not concern it is ignored. One thread.
class StepActivity {
 public:
  virtual ~StepActivity() = default;

  virtual void describe(LessonPrompt& prompt) const = 0;
  virtual void go_on(double) {}
  virtual void answer(std::size_t, double) {}
  virtual void felt(const FeltCycle&, double) {}
  virtual void reset(double now_s) = 0;  // the trial under way
  virtual bool done() const = 0;
  virtual bool may_pause() const { return true; }   // nothing of a trial would be lost if it began again
  virtual bool says_stop() const { return false; }  // the participant had better end here
};

std::unique_ptr<StepActivity> make_text_activity(const StepContext& context, double now_s);
std::unique_ptr<StepActivity> make_cycle_activity(const StepContext& context, double now_s);  // Free and Cycle
std::unique_ptr<StepActivity> make_identify_activity(const StepContext& context, double now_s);
std::unique_ptr<StepActivity> make_threshold_activity(const StepContext& context, double now_s);
std::unique_ptr<StepActivity> make_draw_activity(const StepContext& context, double now_s);
std::unique_ptr<StepActivity> make_question_activity(const StepContext& context, double now_s);

// Practice trials first, then the counted ones, both from 1.
class TrialCount {
 public:
  explicit TrialCount(const LessonStep& step) : practice_(step.practice), counted_(step.trials) {}

  bool practice() const { return done_ < practice_; }
  int number() const { return 1 + (practice() ? done_ : done_ - practice_); }
  int of() const { return practice() ? practice_ : counted_; }
  bool done() const { return done_ >= practice_ + counted_; }
  void next() { ++done_; }

  // "Trial 3 of 12"
  std::string text(const Phrases& phrases) const;

 private:
  int practice_, counted_;
  int done_ = 0;
};

}  // namespace afm::exhibit
