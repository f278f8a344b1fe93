// SPDX-License-Identifier: Apache-2.0
#include "exhibit/lesson/lesson_run.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "exhibit/lesson/williams.h"
#include "physics/quantity_text.h"
#include "step_activity.h"

namespace afm::exhibit {

namespace {

constexpr double kMinuteS = 60;
constexpr double kLongestTrialS = 120;  // time after the break has become due; then the break interrupts the trial
constexpr double kTooEarlyS = 2;        // time in which an answer was meant for the prompt before the automatic break

using MakeActivity = std::unique_ptr<StepActivity> (*)(const StepContext& context, double now_s);
struct ActivityRow {
  StepKind kind;
  MakeActivity make;
};
constexpr std::array kActivities{
    ActivityRow{StepKind::Text, make_text_activity},           ActivityRow{StepKind::Free, make_cycle_activity},
    ActivityRow{StepKind::Cycle, make_cycle_activity},         ActivityRow{StepKind::Identify, make_identify_activity},
    ActivityRow{StepKind::Threshold, make_threshold_activity}, ActivityRow{StepKind::Draw, make_draw_activity},
    ActivityRow{StepKind::Question, make_question_activity},   ActivityRow{StepKind::Push, make_push_activity},
    ActivityRow{StepKind::Write, make_write_activity}};
static_assert(core::has_row_for_each(kActivities, &ActivityRow::kind));

// Reason why a cycle, a push or lines with this force do not count.
Phrase note_of(StepKind kind, HandForce force, HandForce wanted) {
  if (kind == StepKind::Push) {
    return force == HandForce::Reduced ? Phrase::LessonPushWasWeak : Phrase::LessonPushWasOff;
  }
  if (kind == StepKind::Write) {
    return force == HandForce::Reduced ? Phrase::LessonWritingWasWeak : Phrase::LessonWritingWasOff;
  }
  if (wanted == HandForce::None) return Phrase::LessonForceWasOn;
  return force == HandForce::Reduced ? Phrase::LessonForceWasWeak : Phrase::LessonForceWasOff;
}

}  // namespace

const std::string& LessonText::in(std::string_view language) const {
  for (std::size_t i = 0; i < kLanguages.size(); ++i) {
    if (kLanguages[i].word == language) return texts[i];
  }
  return texts.front();
}

LessonRun::LessonRun(const Lesson& lesson, std::span<const curves::SampleModel> samples, const Phrases& phrases,
                     const Setup& setup, TrialSink sink, double now_s)
    : lesson_(lesson),
      samples_(samples),
      phrases_(phrases),
      sink_(std::move(sink)),
      random_(setup.seed),
      stage_(setup.ask_consent ? Stage::Consent : Stage::Steps),
      began_s_(now_s),
      stretch_began_s_(now_s),
      consented_(!setup.ask_consent) {
  plan(setup.order);
  begin_task(now_s);
}

LessonRun::~LessonRun() = default;

// Plans the order of the steps; a run of steps is repeated under each condition as a whole.
void LessonRun::plan(std::size_t order) {
  const auto orders = williams_orders(lesson_.conditions.size());
  const std::vector<LessonStep>& steps = lesson_.steps;
  for (std::size_t i = 0; i < steps.size();) {
    if (!steps[i].each_condition) {
      tasks_.push_back({i++, std::nullopt});
      continue;
    }
    std::size_t end = i;
    while (end < steps.size() && steps[end].each_condition) ++end;
    for (const std::size_t condition : orders[order % orders.size()]) {
      for (std::size_t step = i; step < end; ++step) tasks_.push_back({step, lesson_.conditions[condition]});
    }
    i = end;
  }
}

void LessonRun::begin_task(double now_s) {
  snapped_in_ = counted_ = false;
  unfelt_.reset();
  step_began_s_ = now_s;
  if (task_ == tasks_.size()) {
    end_ = LessonEnd::Finished;
    return;
  }
  const LessonStep& step = lesson_.steps[tasks_[task_].step];
  const StepContext context{step,
                            lesson_.set.get(),
                            samples_,
                            phrases_,
                            random_,
                            [this](TrialRow row) {
                              if (auto kept = keep(std::move(row)); !kept && !error_) error_ = kept.error();
                            },
                            [this](core::Error error) {
                              if (!error_) error_ = std::move(error);
                            }};
  activity_ = kActivities[core::index_of(step.kind)].make(context, now_s);
}

core::Result<void> LessonRun::keep(TrialRow row) {
  const Task& task = tasks_[task_];
  row.onset_s -= began_s_;
  row.step = lesson_.steps[task.step].id;
  row.kind = lesson_.steps[task.step].kind;
  row.condition = task.condition;
  if (row.push) row.push->truth = row.push->truth && task.condition != Condition::Haptics;
  if (row.push) note_result(row);
  if (study::row_of(row.kind).has_cycles && !row.force) row.force = counted_ && wanted_force() == HandForce::Full;
  return sink_(row);
}

// Stores the result of a blind push, which is announced with the next step.
void LessonRun::note_result(const TrialRow& row) {
  if (row.response.empty()) return;
  const bool line = row.stimulus == row_of(PushUntil::Line).word;
  if (!line && row.stimulus != row_of(PushUntil::Threshold).word) return;
  const double result = std::stod(row.response);
  result_task_ = task_ + 1;
  result_ = line ? phrases_.text<Phrase::LessonLineWas>(
                       phrases_.number(physics::format_quantity(physics::Length(result), physics::kLengthUnits, 3)))
                 : phrases_.text<Phrase::LessonThresholdWas>(fmt::format("{:.0f} %", 100.0 * result));
}

LessonPrompt LessonRun::prompt(double now_s) const {
  LessonPrompt prompt;
  prompt.title = lesson_.title.in(phrases_[Phrase::Language]);
  if (stage_ == Stage::Consent && !end_) {
    prompt.wants = LessonPrompt::Wants::Answer;
    prompt.words = phrases_[Phrase::LessonConsent];
    prompt.answers = {phrases_[Phrase::LessonConsentYes], phrases_[Phrase::LessonConsentNo]};
    return prompt;
  }
  if (stage_ == Stage::Break && !end_) {
    prompt.wants = LessonPrompt::Wants::Answer;
    prompt.words = phrases_[Phrase::LessonBreak];
    prompt.answers = {phrases_[Phrase::LessonGoOn], phrases_[Phrase::LessonStop]};
    return prompt;
  }
  if (end_ || error_) {
    prompt.wants = LessonPrompt::Wants::Nothing;
    const bool finished = end_ == LessonEnd::Finished && !error_;
    prompt.words = phrases_[finished ? Phrase::LessonFinished : Phrase::LessonStopped];
    return prompt;
  }
  const Task& task = tasks_[task_];
  const LessonStep& step = lesson_.steps[task.step];
  prompt.in_step = true;
  prompt.kind = step.kind;
  prompt.task = task_;
  prompt.condition = task.condition;
  activity_->describe(prompt);
  if (!result_.empty() && task_ == result_task_) prompt.words = result_ + " " + prompt.words;
  if (unfelt_ && prompt.by_hand()) {
    prompt.words = phrases_[note_of(prompt.kind, *unfelt_, wanted_force())] + " " + prompt.words;
  }
  const bool time_for_hint = !step.hint.empty() && now_s - step_began_s_ >= step.hint_after_s;
  if (time_for_hint) prompt.hint = step.hint.in(phrases_[Phrase::Language]);
  const std::string where = phrases_.text<Phrase::LessonStep>(std::to_string(task_ + 1), std::to_string(tasks_.size()));
  prompt.progress = prompt.progress.empty() ? where : where + " \u00b7 " + prompt.progress;
  return prompt;
}

void LessonRun::happened(const scene::TipEvent& event, double now_s) {
  if (end_ || error_ || stage_ != Stage::Steps || event.material < 0) return;
  const LessonPrompt wanted = prompt(now_s);
  const auto material = static_cast<std::size_t>(event.material);
  if (wanted.wants != LessonPrompt::Wants::Cycle || (wanted.material && *wanted.material != material)) return;
  if (physics::begins_cycle(event.kind)) {
    snapped_in_ = true;
    if (force_ != wanted_force()) return repeat_trial(now_s);
  }
  if (!physics::ends_cycle(event.kind) || !std::exchange(snapped_in_, false)) return;
  unfelt_.reset();
  counted_ = true;
  activity_->felt({.material = material, .f_ad_n = std::abs(event.force_before_n)}, now_s);
  follow(now_s);
}

void LessonRun::force_is(HandForce force, double now_s) {
  force_ = force;
  if (end_ || error_ || stage_ != Stage::Steps || !snapped_in_) return;
  if (force_ != wanted_force()) repeat_trial(now_s);
}

void LessonRun::add(const scene::TipEvent& event) {
  if (!end_ && !error_ && stage_ == Stage::Steps) activity_->add(event);
}

void LessonRun::add(const scene::TipSample& sample, double now_s) {
  if (end_ || error_ || stage_ != Stage::Steps) return;
  const bool waited = activity_->waits_for_state();
  if (waited && force_ != wanted_force()) return;
  activity_->add(sample);
  if (waited && !activity_->waits_for_state()) {
    // the question ends the cycle, so it is no fault that the lesson now removes the force
    snapped_in_ = false;
    unfelt_.reset();
    counted_ = true;
  }
  if (!activity_->counts(sample)) return;
  if (force_ != wanted_force()) return repeat_trial(now_s);
  unfelt_.reset();
}

void LessonRun::look(std::span<const scene::ParticlePage> pages, double now_s) {
  if (end_ || error_ || stage_ != Stage::Steps) return;
  activity_->look(pages, now_s);
  if (activity_->done()) follow(now_s);
}

void LessonRun::look_at_marks(std::span<const scene::MarkTile> tiles, double now_s) {
  if (end_ || error_ || stage_ != Stage::Steps) return;
  activity_->look_at_marks(tiles, now_s);
  if (activity_->done()) follow(now_s);
}

HandForce LessonRun::wanted_force() const {
  return tasks_[task_].condition == Condition::Picture ? HandForce::None : HandForce::Full;
}

void LessonRun::repeat_trial(double now_s) {
  snapped_in_ = false;
  unfelt_ = force_;
  TrialRow row = activity_->trial(now_s);
  row.force = wanted_force() == HandForce::None;
  if (auto kept = keep(std::move(row)); !kept && !error_) error_ = kept.error();
  activity_->reset(now_s);
}

void LessonRun::watch_time(double now_s) {
  if (end_ || error_ || stage_ != Stage::Steps) return;
  if (offer_break_where_due(now_s)) break_answers_from_s_ = now_s + kTooEarlyS;
}

void LessonRun::go_on(double now_s) {
  if (end_ || error_ || stage_ != Stage::Steps) return;
  activity_->go_on(now_s);
  follow(now_s);
}

void LessonRun::answer(std::size_t answer, double now_s) {
  if (end_ || error_ || answer >= prompt(now_s).answers.size()) return;
  if (stage_ == Stage::Steps) {
    activity_->answer(answer, now_s);
    return follow(now_s);
  }
  if (now_s < break_answers_from_s_) return;
  const bool yes = answer == 0;
  const bool consent = std::exchange(stage_, Stage::Steps) == Stage::Consent;
  stretch_began_s_ = now_s;
  if (!yes) {
    end_ = consent ? LessonEnd::Withdrew : LessonEnd::Stopped;
  } else if (consent) {
    consented_ = true;
    began_s_ = now_s;
    begin_task(now_s);
  } else {
    reset(now_s);
  }
}

void LessonRun::skip(double now_s) {
  if (end_ || error_ || stage_ != Stage::Steps) return;
  ++task_;
  begin_task(now_s);
}

void LessonRun::reset(double now_s) {
  if (end_ || error_ || stage_ != Stage::Steps) return;
  snapped_in_ = false;
  unfelt_.reset();
  step_began_s_ = now_s;
  activity_->reset(now_s);
}

void LessonRun::stop() {
  if (!end_) end_ = consented_ ? LessonEnd::Stopped : LessonEnd::Withdrew;
}

void LessonRun::follow(double now_s) {
  if (error_) return;
  if (activity_->says_stop()) {
    end_ = LessonEnd::Stopped;
    return;
  }
  if (activity_->done()) {
    ++task_;
    begin_task(now_s);
  }
  if (!end_) offer_break_where_due(now_s);
}

bool LessonRun::offer_break_where_due(double now_s) {
  const double late_s = now_s - stretch_began_s_ - kMostLessonMinutes * kMinuteS;
  if (late_s < 0.0 || snapped_in_ || (late_s < kLongestTrialS && !activity_->may_pause())) return false;
  stage_ = Stage::Break;
  return true;
}

}  // namespace afm::exhibit
