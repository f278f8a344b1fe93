// SPDX-License-Identifier: Apache-2.0
// Steps with right and wrong answers: blind identification, thresholds, and drawing the curve.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "exhibit/lesson/lesson_samples.h"
#include "exhibit/lesson/staircase.h"
#include "step_activity.h"

namespace afm::exhibit {

namespace {

// Feedback on the answer, for practice trials.
std::string feedback(const Phrases& phrases, bool right, const std::string& right_answer) {
  return right ? phrases[Phrase::LessonRight] : phrases.text<Phrase::LessonWrong>(right_answer);
}

std::string joined(const std::string& note, const std::string& words) {
  return note.empty() ? words : note + " " + words;
}

class IdentifyActivity final : public StepActivity {
 public:
  IdentifyActivity(StepContext context, double now_s)
      : context_(std::move(context)), count_(context_.step), began_s_(now_s) {
    // all materials occur equally often among the counted trials, as far as their number allows
    const std::size_t materials = context_.step.materials.size();
    for (int i = 0; i < context_.step.practice; ++i) shown_.push_back(context_.random.below(materials));
    std::vector<std::size_t> counted;
    std::vector<std::size_t> round(materials);
    std::iota(round.begin(), round.end(), std::size_t{0});
    while (counted.size() < static_cast<std::size_t>(context_.step.trials)) {
      context_.random.shuffle(std::span<std::size_t>(round));
      counted.insert(counted.end(), round.begin(), round.end());
    }
    counted.resize(static_cast<std::size_t>(context_.step.trials));
    context_.random.shuffle(std::span<std::size_t>(counted));
    shown_.insert(shown_.end(), counted.begin(), counted.end());
  }

  void describe(LessonPrompt& prompt) const override {
    prompt.hidden = true;
    prompt.material = context_.step.materials[shown_[trial_]];
    prompt.cycle = static_cast<std::uint32_t>(trial_);
    prompt.progress = count_.text(context_.phrases);
    prompt.right = shown_[trial_];
    prompt.has_right = true;
    if (!felt_) {
      prompt.wants = LessonPrompt::Wants::Cycle;
      prompt.words = joined(note_, context_.words());
      return;
    }
    prompt.wants = LessonPrompt::Wants::Answer;
    prompt.words = context_.phrases[Phrase::LessonWhich];
    for (const std::size_t material : context_.step.materials) prompt.answers.push_back(title(material));
  }
  void felt(const FeltCycle&, double now_s) override {
    if (std::exchange(felt_, true)) return;
    asked_s_ = now_s;
  }
  void answer(std::size_t answer, double now_s) override {
    if (!felt_ || answer >= context_.step.materials.size()) return;
    const std::size_t shown = context_.step.materials[shown_[trial_]];
    const bool right = answer == shown_[trial_];
    note_ = count_.practice() ? feedback(context_.phrases, right, title(shown)) : "";
    TrialRow row = trial(now_s);
    row.response = name(context_.step.materials[answer]);
    row.correct = right;
    row.rt_s = now_s - asked_s_;
    context_.keep(std::move(row));
    count_.next();
    if (!count_.done()) ++trial_;
    reset(now_s);
  }
  TrialRow trial(double now_s) const override {
    return {.onset_s = began_s_,
            .duration_s = now_s - began_s_,
            .practice = count_.practice(),
            .trial = count_.number(),
            .stimulus = name(context_.step.materials[shown_[trial_]])};
  }
  void reset(double now_s) override {
    felt_ = false;
    began_s_ = now_s;
  }
  bool done() const override { return count_.done(); }
  bool may_pause() const override { return !felt_; }

 private:
  std::string title(std::size_t material) const {
    return context_.phrases.word(context_.samples[material].setup.material.title);
  }
  std::string name(std::size_t material) const { return context_.samples[material].setup.material.name; }

  StepContext context_;
  TrialCount count_;
  std::vector<std::size_t> shown_;  // index into the step's materials for each trial
  std::size_t trial_ = 0;
  bool felt_ = false;
  std::string note_;
  double began_s_, asked_s_ = 0;
};

// Step in which the hand moves the swing through both states. At a random height at which both exist, and in the drawn
// state, the lesson asks which it is, so that no height gives the answer.
class StateActivity final : public StepActivity {
 public:
  StateActivity(StepContext context, double now_s) : context_(std::move(context)), count_(context_.step) {
    for (int i = 0; i < context_.step.practice; ++i) shown_.push_back(context_.random.below(kStates.size()));
    std::vector<std::size_t> counted(static_cast<std::size_t>(context_.step.trials));
    for (std::size_t i = 0; i < counted.size(); ++i) counted[i] = i % kStates.size();
    context_.random.shuffle(std::span<std::size_t>(counted));
    shown_.insert(shown_.end(), counted.begin(), counted.end());
    reset(now_s);
  }

  void describe(LessonPrompt& prompt) const override {
    prompt.hidden = prompt.of_states = true;
    prompt.material = context_.step.materials.front();
    prompt.cycle = static_cast<std::uint32_t>(trial_);
    prompt.progress = count_.text(context_.phrases);
    prompt.right = shown_[trial_];
    prompt.has_right = true;
    if (!asked_s_) {
      prompt.wants = LessonPrompt::Wants::Cycle;
      prompt.words = joined(note_, context_.words());
      return;
    }
    prompt.wants = LessonPrompt::Wants::Answer;
    prompt.words = context_.phrases[Phrase::LessonState];
    for (const StateRow& row : kStates) prompt.answers.push_back(context_.phrases[row.title]);
  }
  void add(const scene::TipSample& sample) override {
    if (asked_s_) return;
    const double z_m = sample.tip.z_m;
    const bool shown = sample.material == static_cast<std::int32_t>(context_.step.materials.front()) &&
                       sample.phase == kStates.at(shown_[trial_]).phase;
    const bool passed = shown && before_m_ && (*before_m_ < ask_m_) != (z_m < ask_m_);
    before_m_ = shown ? std::optional(z_m) : std::nullopt;
    if (passed) asked_s_ = static_cast<double>(sample.time_ns) * 1e-9;
  }
  bool waits_for_state() const override { return !asked_s_; }
  void answer(std::size_t answer, double now_s) override {
    if (!asked_s_ || answer >= kStates.size()) return;
    const bool right = answer == shown_[trial_];
    const std::string& right_answer = context_.phrases[kStates.at(shown_[trial_]).title];
    note_ = count_.practice() ? feedback(context_.phrases, right, right_answer) : "";
    TrialRow row = trial(now_s);
    row.response = kStates.at(answer).word;
    row.correct = right;
    row.rt_s = now_s - *asked_s_;
    context_.keep(std::move(row));
    count_.next();
    if (count_.done()) return;
    ++trial_;
    reset(now_s);
  }
  TrialRow trial(double now_s) const override {
    return {.onset_s = began_s_,
            .duration_s = now_s - began_s_,
            .practice = count_.practice(),
            .trial = count_.number(),
            .stimulus = std::string(kStates.at(shown_[trial_]).word)};
  }
  void reset(double now_s) override {
    const physics::CycleFigures& figures = context_.samples[context_.step.materials.front()].figures();
    const double share = 0.3 + 0.4 * context_.random.unit();
    ask_m_ = figures.z_jtc.si + share * (figures.z_joc - figures.z_jtc).si;
    asked_s_.reset();
    before_m_.reset();
    began_s_ = now_s;
  }
  bool done() const override { return count_.done(); }
  bool may_pause() const override { return !asked_s_; }

 private:
  struct StateRow {
    physics::Phase phase;
    std::string_view word;  // word in the results
    Phrase title;
  };
  static constexpr std::array kStates{StateRow{physics::Phase::Free, "attractive", Phrase::SwingAttractive},
                                      StateRow{physics::Phase::Attached, "repulsive", Phrase::SwingRepulsive}};

  StepContext context_;
  TrialCount count_;
  std::vector<std::size_t> shown_;  // index into kStates for each trial
  std::size_t trial_ = 0;
  double ask_m_ = 0;                // Z at which the question is asked
  std::optional<double> before_m_;  // Z of the previous sample in the state of the trial
  std::optional<double> asked_s_;   // time of the question
  std::string note_;
  double began_s_ = 0;
};

// Step whose trials are two cycles, one of which has the stronger pull-off.
class ThresholdActivity final : public StepActivity {
 public:
  ThresholdActivity(StepContext context, double now_s)
      : context_(std::move(context)), count_(context_.step), staircase_(make_staircase(plan())) {
    begin(now_s);
  }

  void describe(LessonPrompt& prompt) const override {
    prompt.hidden = true;
    prompt.material = context_.step.materials.front();
    prompt.variant = intervals_[std::min<std::size_t>(felt_, 1)].parameters;
    prompt.cycle = cycle_;
    prompt.progress = count_.text(context_.phrases);
    prompt.right = stronger_;
    prompt.has_right = true;
    if (felt_ < 2) {
      prompt.wants = LessonPrompt::Wants::Cycle;
      const Phrase which = felt_ == 0 ? Phrase::LessonFirst : Phrase::LessonSecond;
      prompt.words =
          joined(felt_ == 0 ? joined(note_, context_.phrases[which]) : context_.phrases[which], context_.words());
      return;
    }
    prompt.wants = LessonPrompt::Wants::Answer;
    prompt.words = context_.phrases[Phrase::LessonStronger];
    prompt.answers = {answer_text(0), answer_text(1)};
  }
  void felt(const FeltCycle&, double now_s) override {
    if (felt_ >= 2) return;
    ++felt_;
    ++cycle_;
    asked_s_ = now_s;
  }
  void answer(std::size_t answer, double now_s) override {
    if (felt_ < 2 || answer > 1) return;
    const bool right = answer == stronger_;
    note_ = count_.practice() ? feedback(context_.phrases, right, answer_text(stronger_)) : "";
    TrialRow row = trial(now_s);
    row.response = word(answer);
    row.correct = right;
    row.rt_s = now_s - asked_s_;
    context_.keep(std::move(row));
    // practice trials all have the first level
    if (!count_.practice()) staircase_->answer(right);
    count_.next();
    if (!count_.done()) begin(now_s);
  }
  TrialRow trial(double now_s) const override {
    return {.onset_s = began_s_,
            .duration_s = now_s - began_s_,
            .practice = count_.practice(),
            .trial = count_.number(),
            .level = w_,
            .stimulus = word(stronger_)};
  }
  void reset(double now_s) override {
    felt_ = 0;
    ++cycle_;
    began_s_ = now_s;
  }
  bool done() const override { return count_.done(); }
  bool may_pause() const override { return felt_ == 0; }

 private:
  const ThresholdPlan& plan() const { return context_.step.threshold; }
  static std::string word(std::size_t interval) { return interval == 0 ? "first" : "second"; }
  const std::string& answer_text(std::size_t interval) const {
    return context_.phrases[interval == 0 ? Phrase::LessonAnswerFirst : Phrase::LessonAnswerSecond];
  }

  void begin(double now_s) {
    w_ = std::pow(10.0, staircase_->level());
    stronger_ = context_.random.below(2);
    for (std::size_t i = 0; i < intervals_.size(); ++i) {
      const double rove = std::pow(1.0 + plan().rove, 2.0 * context_.random.unit() - 1.0);
      auto sample = comparison_sample(context_.samples[context_.step.materials.front()], plan().distance,
                                      i == stronger_ ? w_ : 0.0, rove);
      if (!sample) return context_.failed(sample.error());
      intervals_[i].parameters = sample->parameters;
    }
    reset(now_s);
  }

  struct Interval {
    scene::SharedContact parameters;
  };

  StepContext context_;
  TrialCount count_;
  std::unique_ptr<Staircase> staircase_;
  std::array<Interval, 2> intervals_;
  double w_ = 0;
  std::size_t stronger_ = 0;
  std::size_t felt_ = 0;
  std::uint32_t cycle_ = 0;
  std::string note_;
  double began_s_ = 0, asked_s_ = 0;
};

// Step in which the participant assembles a curve from five parts, by choosing each one's shape: needs no aim, and
// works by ear.
class DrawActivity final : public StepActivity {
 public:
  static constexpr std::size_t kParts = 5;

  DrawActivity(StepContext context, double now_s) : context_(std::move(context)), count_(context_.step) {
    reset(now_s);
  }

  void describe(LessonPrompt& prompt) const override {
    prompt.wants = LessonPrompt::Wants::Answer;
    prompt.hidden = true;  // the curve on the wall would be the answer
    prompt.words = joined(part_ == 0 ? context_.words() : "", context_.phrases[after(Phrase::DrawPart1, part_)]);
    for (std::size_t i = 0; i < kParts; ++i) {
      prompt.answers.push_back(context_.phrases[after(Phrase::DrawShape1, shapes_[i])]);
      if (shapes_[i] == part_) prompt.right = i;
    }
    prompt.has_right = true;
    prompt.progress = count_.text(context_.phrases);
  }
  void answer(std::size_t answer, double now_s) override {
    if (answer >= kParts) return;
    right_ += shapes_[answer] == part_ ? 1 : 0;
    if (++part_ < kParts) return;
    context_.keep({.onset_s = began_s_,
                   .duration_s = now_s - began_s_,
                   .practice = count_.practice(),
                   .trial = count_.number(),
                   .response = fmt::format("{:.6g}", static_cast<double>(right_) / kParts),
                   .rt_s = now_s - began_s_});
    count_.next();
    if (!count_.done()) reset(now_s);
  }
  void reset(double now_s) override {
    part_ = 0;
    right_ = 0;
    began_s_ = now_s;
    std::iota(shapes_.begin(), shapes_.end(), std::size_t{0});
    context_.random.shuffle(std::span<std::size_t>(shapes_));
  }
  bool done() const override { return count_.done(); }
  bool may_pause() const override { return part_ == 0; }

 private:
  StepContext context_;
  TrialCount count_;
  std::array<std::size_t, kParts> shapes_{};  // in the order offered
  std::size_t part_ = 0;
  int right_ = 0;
  double began_s_ = 0;
};

static_assert(after(Phrase::DrawPart1, DrawActivity::kParts) == Phrase::DrawShape1);

}  // namespace

std::unique_ptr<StepActivity> make_identify_activity(const StepContext& context, double now_s) {
  if (context.step.states) return std::make_unique<StateActivity>(context, now_s);
  return std::make_unique<IdentifyActivity>(context, now_s);
}

std::unique_ptr<StepActivity> make_threshold_activity(const StepContext& context, double now_s) {
  return std::make_unique<ThresholdActivity>(context, now_s);
}

std::unique_ptr<StepActivity> make_draw_activity(const StepContext& context, double now_s) {
  return std::make_unique<DrawActivity>(context, now_s);
}

}  // namespace afm::exhibit
