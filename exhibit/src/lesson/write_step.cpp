// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/check.h"
#include "scene/samples/particle_set.h"
#include "step_activity.h"
#include "write_trial.h"

namespace afm::exhibit {

namespace {

// Reason why the lines are not done, with a remedy.
std::string words_of(WritingFault fault, const WrittenLines& written, const LinesToWrite& lines, bool ink,
                     const Phrases& phrases) {
  const std::string width = length_words(written.width_m), wanted = length_words(lines.width_m);
  switch (fault) {
    case WritingFault::MarksOutside:
      return phrases.text<Phrase::LessonMarksOutside>(length_words(kOutsideWidths * lines.width_m));
    case WritingFault::TooNarrow:
      if (ink) return phrases.text<Phrase::LessonInkTooNarrow>(width, wanted);
      return phrases.text<Phrase::LessonTooNarrow>(width, wanted);
    case WritingFault::TooWide:
      if (ink) return phrases.text<Phrase::LessonInkTooWide>(width, wanted);
      return phrases.text<Phrase::LessonTooWide>(width, wanted);
    case WritingFault::LinesLeft:
      break;
  }
  return phrases.text<Phrase::LessonLinesLeft>(fmt::format("{:.0f} %", std::floor(100.0 * written.share)));
}

// Step with one trial: waits until the sample is level and the tip is off it, then until the lines are written.
class WriteActivity final : public StepActivity {
 public:
  WriteActivity(StepContext context, double now_s) : context_(std::move(context)), began_s_(now_s) {}

  void describe(LessonPrompt& prompt) const override {
    const LinesToWrite& lines = *context_.step.lines;
    prompt.wants = LessonPrompt::Wants::Write;
    prompt.words = context_.words();
    if (const auto fault = trial_ ? trial_->fault() : std::nullopt) {
      prompt.words = words_of(*fault, trial_->written(), lines, context_.particles->ink != nullptr, context_.phrases) +
                     " " + prompt.words;
    }
    prompt.lines = &lines;
    prompt.material = 0;
    prompt.put_back = !trial_;
  }
  void add(const scene::TipEvent& event) override {
    if (trial_) trial_->add(event);
  }
  void add(const scene::TipSample& sample) override {
    const bool level = sample.push.digest == scene::kSoftDigest && sample.push.state == physics::PushState::Free;
    if (!trial_ && !done_ && level) trial_.emplace(*context_.particles, *context_.step.lines);
    if (trial_) trial_->add(sample);
  }
  void look_at_marks(std::span<const scene::MarkTile> tiles, double now_s) override {
    if (done_ || !trial_ || !trial_->look(tiles)) return;
    done_ = true;
    TrialRow row = trial(now_s);
    row.response = fmt::format("{:.6g}", trial_->score().rms_m);
    add_score(trial_->score(), row);
    context_.keep(std::move(row));
  }
  bool counts(const scene::TipSample& sample) const override {
    return trial_ && !done_ && sample.push.state != physics::PushState::Free;
  }
  TrialRow trial(double now_s) const override { return {.onset_s = began_s_, .duration_s = now_s - began_s_}; }
  void reset(double now_s) override {
    began_s_ = now_s;
    trial_.reset();
  }
  bool done() const override { return done_; }
  bool may_pause() const override { return !trial_ || trial_->score().state == scene::TaskState::NotBegun; }

 private:
  StepContext context_;
  double began_s_;
  std::optional<WriteTrial> trial_;  // nothing while the sample is to be made level
  bool done_ = false;
};

}  // namespace

std::unique_ptr<StepActivity> make_write_activity(const StepContext& context, double now_s) {
  AFM_CHECK(context.particles != nullptr && scene::leaves_marks(*context.particles));
  AFM_CHECK(context.step.lines != nullptr);
  return std::make_unique<WriteActivity>(context, now_s);
}

}  // namespace afm::exhibit
