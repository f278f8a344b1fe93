// SPDX-License-Identifier: Apache-2.0
// Text, free exploration, guided cycles and questionnaires.
#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "exhibit/lesson/questionnaire.h"
#include "step_activity.h"
#include "study/questionnaires.h"

namespace afm::exhibit {

std::string TrialCount::text(const Phrases& phrases) const {
  const std::string number = std::to_string(this->number()), of = std::to_string(this->of());
  return practice() ? phrases.text<Phrase::LessonPractice>(number, of) : phrases.text<Phrase::LessonTrial>(number, of);
}

namespace {

class TextActivity final : public StepActivity {
 public:
  TextActivity(StepContext context, double now_s) : context_(std::move(context)), began_s_(now_s) {}

  void describe(LessonPrompt& prompt) const override {
    prompt.wants = LessonPrompt::Wants::GoOn;
    prompt.words = context_.words();
  }
  void go_on(double now_s) override {
    done_ = true;
    context_.keep({.onset_s = began_s_, .duration_s = now_s - began_s_});
  }
  void reset(double now_s) override { began_s_ = now_s; }
  bool done() const override { return done_; }

 private:
  StepContext context_;
  double began_s_;
  bool done_ = false;
};

// Step of free exploration: one trial with a number of cycles on any of its materials.
class CycleActivity final : public StepActivity {
 public:
  CycleActivity(StepContext context, double now_s)
      : context_(std::move(context)),
        free_(context_.step.kind == StepKind::Free),
        count_(context_.step),
        began_s_(now_s) {}

  void describe(LessonPrompt& prompt) const override {
    prompt.wants = LessonPrompt::Wants::Cycle;
    prompt.words = context_.words();
    prompt.progress = count_.text(context_.phrases);
    if (context_.step.materials.size() == 1) prompt.material = context_.step.materials.front();
    prompt.cycle = cycle_;
  }
  void go_on(double now_s) override {
    if (free_) end_free(now_s);
  }
  void felt(const FeltCycle& cycle, double now_s) override {
    if (!free_) {
      TrialRow row = trial(now_s);
      row.response = fmt::format("{:.6g}", cycle.f_ad_n);
      context_.keep(std::move(row));
      began_s_ = now_s;
    }
    ++cycle_;
    count_.next();
    if (free_ && count_.done()) end_free(now_s);
  }
  TrialRow trial(double now_s) const override {
    TrialRow row{.onset_s = began_s_, .duration_s = now_s - began_s_};
    if (free_) return row;
    row.practice = count_.practice();
    row.trial = count_.number();
    return row;
  }
  void reset(double now_s) override { began_s_ = now_s; }
  bool done() const override { return done_ || count_.done(); }

 private:
  void end_free(double now_s) {
    if (std::exchange(done_, true)) return;
    context_.keep(trial(now_s));
  }

  StepContext context_;
  bool free_;
  TrialCount count_;
  double began_s_;
  std::uint32_t cycle_ = 0;
  bool done_ = false;
};

class QuestionActivity final : public StepActivity {
 public:
  QuestionActivity(StepContext context, double now_s)
      : context_(std::move(context)), row_(row_of(context_.step.questionnaire)), asked_s_(now_s) {}

  void describe(LessonPrompt& prompt) const override {
    prompt.wants = LessonPrompt::Wants::Answer;
    prompt.words = context_.phrases[after(row_.first_item, values_.size())];
    prompt.hint = values_.empty() ? context_.words() : "";
    prompt.answers = answers_of(row_.questionnaire, context_.phrases);
    prompt.marked = prompt.answers.size() / 2;
    prompt.progress =
        context_.phrases.text<Phrase::LessonQuestion>(std::to_string(values_.size() + 1), std::to_string(row_.items));
    prompt.item = item_id(row_.questionnaire, values_.size());
  }
  void answer(std::size_t answer, double now_s) override {
    const int value = value_of(row_.questionnaire, answer);
    if (value > row_.most) return;
    const auto trial = static_cast<int>(values_.size() + 1);
    std::string item = item_id(row_.questionnaire, values_.size());
    values_.push_back(value);
    context_.keep({.onset_s = asked_s_,
                   .duration_s = now_s - asked_s_,
                   .trial = trial,
                   .stimulus = std::move(item),
                   .response = std::to_string(value),
                   .rt_s = now_s - asked_s_});
    asked_s_ = now_s;
  }
  void reset(double now_s) override { asked_s_ = now_s; }
  bool done() const override { return values_.size() == row_.items; }
  bool says_stop() const override {
    return done() && row_.questionnaire == Questionnaire::Ssq &&
           study::ssq_says_stop(std::span<const double, 16>(values_));
  }

 private:
  StepContext context_;
  const QuestionnaireRow& row_;
  std::vector<double> values_;
  double asked_s_;
};

}  // namespace

std::unique_ptr<StepActivity> make_text_activity(const StepContext& context, double now_s) {
  return std::make_unique<TextActivity>(context, now_s);
}

std::unique_ptr<StepActivity> make_cycle_activity(const StepContext& context, double now_s) {
  return std::make_unique<CycleActivity>(context, now_s);
}

std::unique_ptr<StepActivity> make_question_activity(const StepContext& context, double now_s) {
  return std::make_unique<QuestionActivity>(context, now_s);
}

}  // namespace afm::exhibit
