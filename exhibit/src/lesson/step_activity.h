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
#include "scene/shared/soft_blocks.h"
#include "scene/shared/task_score.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// Inputs of a step. All referenced objects must outlive the step.
struct StepContext {
  const LessonStep& step;
  const scene::ParticleSet* particles;           // particles of the lesson; null: none
  std::span<const curves::SampleModel> samples;  // samples of the lesson
  const Phrases& phrases;
  LessonRandom& random;
  std::function<void(TrialRow)> keep;       // receiver of a finished trial; step, kind and condition are filled in
  std::function<void(core::Error)> failed;  // receiver of an error that ends the lesson

  std::string words() const { return step.words.in(phrases[Phrase::Language]); }
};

// A running step. Ignores irrelevant calls. One thread.
class StepActivity {
 public:
  virtual ~StepActivity() = default;

  virtual void describe(LessonPrompt& prompt) const = 0;
  virtual void go_on(double) {}
  virtual void answer(std::size_t, double) {}
  virtual void felt(const FeltCycle&, double) {}

  // Input for a push, for writing, and for the state of a swing: events and samples of the servo in order, the events
  // of a tick before its sample; then pages, or tiles.
  virtual void add(const scene::TipEvent&) {}
  virtual void add(const scene::TipSample&) {}
  virtual void look(std::span<const scene::ParticlePage>, double) {}
  virtual void look_at_marks(std::span<const scene::MarkTile>, double) {}
  virtual bool counts(const scene::TipSample&) const { return false; }  // true: touch that belongs to the trial
  virtual bool waits_for_state() const { return false; }                // needs samples with the condition's force

  virtual TrialRow trial(double) const { return {}; }  // running trial without its answer
  virtual void reset(double now_s) = 0;                // restarts the running trial
  virtual bool done() const = 0;
  virtual bool may_pause() const { return true; }   // true: an interruption would lose nothing of a trial
  virtual bool says_stop() const { return false; }  // true: advice for the participant to end here
};

std::unique_ptr<StepActivity> make_text_activity(const StepContext& context, double now_s);
std::unique_ptr<StepActivity> make_cycle_activity(const StepContext& context, double now_s);  // steps Free and Cycle
std::unique_ptr<StepActivity> make_identify_activity(const StepContext& context, double now_s);
std::unique_ptr<StepActivity> make_threshold_activity(const StepContext& context, double now_s);
std::unique_ptr<StepActivity> make_draw_activity(const StepContext& context, double now_s);
std::unique_ptr<StepActivity> make_question_activity(const StepContext& context, double now_s);
std::unique_ptr<StepActivity> make_push_activity(const StepContext& context, double now_s);
std::unique_ptr<StepActivity> make_write_activity(const StepContext& context, double now_s);

// Adds time and figures of a finished task.
void add_score(const scene::TaskScore& score, TrialRow& row);

// Counts practice trials, then counted ones, both from 1.
class TrialCount {
 public:
  explicit TrialCount(const LessonStep& step) : practice_(step.practice), counted_(step.trials) {}

  bool practice() const { return done_ < practice_; }
  int number() const { return 1 + (practice() ? done_ : done_ - practice_); }
  int of() const { return practice() ? practice_ : counted_; }
  bool done() const { return done_ >= practice_ + counted_; }
  void next() { ++done_; }

  // Progress such as "Trial 3 of 12".
  std::string text(const Phrases& phrases) const;

 private:
  int practice_, counted_;
  int done_ = 0;
};

}  // namespace afm::exhibit
