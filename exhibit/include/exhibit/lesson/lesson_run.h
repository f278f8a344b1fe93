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
#include "exhibit/lesson/hand_force.h"
#include "exhibit/lesson/lesson.h"
#include "exhibit/lesson/lesson_prompt.h"
#include "exhibit/lesson/lesson_random.h"
#include "exhibit/lesson/trial_row.h"
#include "exhibit/words/phrases.h"
#include "scene/shared/soft_blocks.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

class StepActivity;

// End of a lesson.
enum class LessonEnd { Finished, Stopped, Withdrew };

// A running lesson: produces prompts and processes the answers. The caller supplies the time, in seconds that never
// decrease, so that a simulated participant needs no clock. Reports finished trials to a sink. One thread.
//
// Only the servo's events satisfy a criterion: a cycle is a jump to contact and a jump off contact on the requested
// material, with the full force on the hand from the one to the other (under the condition "picture": with none).
// Otherwise the lesson says why it does not count, keeps the attempt as a trial without an answer, and begins the
// running trial again, with the same stimuli. After kMostLessonMinutes the lesson offers a break, even without any
// input: before the next trial, or while an interruption would not lose part of one. A trial that takes two more
// minutes restarts after the break.
class LessonRun {
 public:
  struct Setup {
    std::uint64_t seed = 0;    // seed of orders and stimuli
    std::size_t order = 0;     // row of the Williams design
    bool ask_consent = false;  // true for a real participant
  };

  // Lesson, samples (lesson_samples(), in that order) and phrases must outlive the object. If consent is required, the
  // sink is not called before consent().
  LessonRun(const Lesson& lesson, std::span<const curves::SampleModel> samples, const Phrases& phrases,
            const Setup& setup, TrialSink sink, double now_s);
  ~LessonRun();
  LessonRun(const LessonRun&) = delete;
  LessonRun& operator=(const LessonRun&) = delete;

  // The prompt at this time.
  LessonPrompt prompt(double now_s) const;

  // Reports the force on the hand from the time of the call onward; None before the first one. Call in the order of the
  // jumps.
  void force_is(HandForce force, double now_s);

  // Handles a jump of the tip on the prompt's material and variant.
  void happened(const scene::TipEvent& event, double now_s);

  // Input for a push, or for lines to write: the servo's events of particles and samples in order, the events of a tick
  // before its sample, and after them the newest pages, or the kMarkTiles newest tiles. A push counts only if the full
  // force was on the hand in every tick in which the tip touched a particle, or the soft sample; otherwise it begins
  // again, with all particles at their start, or a level sample.
  void add(const scene::TipEvent& event);
  void add(const scene::TipSample& sample, double now_s);
  void look(std::span<const scene::ParticlePage> pages, double now_s);
  void look_at_marks(std::span<const scene::MarkTile> tiles, double now_s);

  // Offers a break once it is due. With a real participant, call once a frame.
  void watch_time(double now_s);

  void go_on(double now_s);
  void answer(std::size_t answer, double now_s);  // no effect unless the prompt has this answer
  void skip(double now_s);                        // skips the rest of the step
  void reset(double now_s);                       // restarts the running trial
  void stop();

  double elapsed_s(double now_s) const { return now_s - began_s_; }  // seconds since the start, including the consent
  bool consented() const { return consented_; }
  std::optional<LessonEnd> end() const { return end_; }
  // Set if a trial could not be stored, which ends the lesson.
  const std::optional<core::Error>& error() const { return error_; }

 private:
  struct Task {
    std::size_t step = 0;
    std::optional<Condition> condition;
  };
  enum class Stage { Consent, Steps, Break };

  void plan(std::size_t order);
  void begin_task(double now_s);
  void follow(double now_s);  // continues after an event or input
  bool offer_break_where_due(double now_s);
  HandForce wanted_force() const;
  void repeat_trial(double now_s);  // restarts a trial whose cycle or push was not felt
  core::Result<void> keep(TrialRow row);
  void note_result(const TrialRow& row);

  const Lesson& lesson_;
  std::span<const curves::SampleModel> samples_;
  const Phrases& phrases_;
  TrialSink sink_;
  LessonRandom random_;
  std::vector<Task> tasks_;
  std::size_t task_ = 0;
  std::unique_ptr<StepActivity> activity_;
  Stage stage_ = Stage::Steps;
  double began_s_ = 0;  // start of the lesson
  double step_began_s_ = 0;
  double stretch_began_s_ = 0;  // time of the last break
  double break_answers_from_s_ = 0;
  bool consented_ = false;
  bool snapped_in_ = false;
  HandForce force_ = HandForce::None;
  std::optional<HandForce> unfelt_;  // force during the cycle or push that did not count; reset by one that counts
  std::string result_;               // text on the newest blind push
  std::size_t result_task_ = 0;      // task whose prompt includes that text
  bool counted_ = false;             // true: at least one cycle of this step counted
  std::optional<LessonEnd> end_;
  std::optional<core::Error> error_;
};

}  // namespace afm::exhibit
