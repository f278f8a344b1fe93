// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "core/check.h"
#include "push_trial.h"
#include "scene/samples/particle_set.h"
#include "step_activity.h"

namespace afm::exhibit {

namespace {

// One-trial step: waits until all particles are at their start and the tip is off them, then until the push is done.
class PushActivity final : public StepActivity {
 public:
  PushActivity(StepContext context, double now_s)
      : context_(std::move(context)), start_(start_digest(*context_.particles)), began_s_(now_s) {}

  void describe(LessonPrompt& prompt) const override {
    prompt.wants = LessonPrompt::Wants::Push;
    prompt.words = context_.words();
    prompt.material = 0;
    prompt.put_back = !trial_;
    prompt.push = context_.step.push;
    prompt.dark = trial_ && trial_->dark();
    prompt.far_enough = prompt.dark && far_enough_;
    // a threshold is to be felt alone
    prompt.hidden = prompt.dark && context_.step.push.until == PushUntil::Threshold;
  }
  void add(const scene::TipEvent& event) override {
    if (trial_) trial_->add(event);
  }
  void add(const scene::TipSample& sample) override {
    touches_ = sample.push.particle != scene::kNoParticle;
    if (trial_) trial_->add(sample);
  }
  void look(std::span<const scene::ParticlePage> pages, double now_s) override {
    if (done_) return;
    if (!trial_) {
      const std::size_t count = context_.particles->particles.size();
      if (touches_) return;
      const bool all = pages.size() >= scene::pages_of(static_cast<std::uint32_t>(count));
      if (all && scene::digest_of(pages, count) == start_) trial_.emplace(*context_.particles, context_.step.push);
      return;
    }
    far_enough_ = trial_->far_enough(pages);
    if (!trial_->look(pages)) return;
    done_ = true;
    TrialRow row = trial(now_s);
    row.response = fmt::format("{:.6g}", trial_->result());
    add_score(trial_->score(), row);
    context_.keep(std::move(row));
  }
  bool counts(const scene::TipSample& sample) const override {
    return trial_ && !done_ && sample.push.particle != scene::kNoParticle;
  }
  TrialRow trial(double now_s) const override {
    return {.onset_s = began_s_,
            .duration_s = now_s - began_s_,
            .stimulus = std::string(row_of(context_.step.push.until).word)};
  }
  void reset(double now_s) override {
    began_s_ = now_s;
    far_enough_ = false;
    trial_.reset();
  }
  bool done() const override { return done_; }
  bool may_pause() const override { return !trial_ || trial_->score().state == scene::TaskState::NotBegun; }

 private:
  StepContext context_;
  std::uint64_t start_;  // digest of the places from which the push begins
  double began_s_;
  std::optional<PushTrial> trial_;  // nothing while the particles are to be put back
  bool touches_ = false;            // true: tip in contact with a particle
  bool far_enough_ = false;         // true: blind push at the end of its line
  bool done_ = false;
};

}  // namespace

void add_score(const scene::TaskScore& score, TrialRow& row) {
  row.rt_s = score.time_s;
  row.force = true;
  row.push = PushFigures{.strokes = score.strokes,
                         .losses = score.losses,
                         .undos = score.undos,
                         .work_j = score.work_j,
                         .largest_lateral_n = score.largest_lateral_n,
                         .truth = score.truth != 0};
}

std::unique_ptr<StepActivity> make_push_activity(const StepContext& context, double now_s) {
  AFM_CHECK(context.particles != nullptr);
  return std::make_unique<PushActivity>(context, now_s);
}

}  // namespace afm::exhibit
