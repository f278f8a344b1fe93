// SPDX-License-Identifier: Apache-2.0
#include "app/options/dynamic_resolution.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>

#include "app/options/command_line.h"
#include "core/check.h"
#include "core/log.h"
#include "exhibit/words/phrases.h"
#include "render/context.h"
#include "render/renderer.h"

namespace afm::app {

namespace {

// Scales of the steps; each draws about 0.7 of the previous one's pixels.
constexpr std::array kScales{1.0, 0.84, 0.71, 0.59, 0.5};
constexpr std::size_t kJudgedFrames = 5;
constexpr double kRoom = 0.85;  // fraction of the budget that a finer frame may be predicted to use
constexpr int kPatienceFrames = 30;
constexpr int kMostPatienceFrames = 1920;
constexpr double kLeastBudget_ms = 1.0, kMostBudget_ms = 1000.0;

// Budget for 20 frames per second with everything moving on two cores. The force is lost only after 250 ms.
constexpr double kProcessorBudget_ms = 48.0;

constexpr double kFourSamplesCost = 2.8;  // largest cost relative to one sample, from the measurements in the design

}  // namespace

DynamicResolution::DynamicResolution(double budget_ms, std::uint32_t samples)
    : budget_ms_(budget_ms), patience_frames_(kPatienceFrames) {
  AFM_CHECK(budget_ms > 0.0);
  for (const double scale : kScales) steps_.push_back({.scale = scale, .samples = samples});
  if (samples > 1) steps_.push_back({.scale = kScales.back(), .samples = 1});
}

bool DynamicResolution::go(std::size_t step) {
  trying_ = step < step_;
  step_ = step;
  recent_ms_.clear();
  steady_frames_ = 0;
  return true;
}

// Next step, or the first one whose resolution could fit: a frame's time never shrinks faster than its number of
// pixels. Goes to fewer samples only from the least resolution, and back from an attempt to the step before it.
std::size_t DynamicResolution::coarser_step() const {
  const auto pixels = [this](std::size_t step) { return steps_[step].scale * steps_[step].scale; };
  std::size_t coarser = step_ + 1;
  if (trying_) return coarser;
  while (coarser + 1 < steps_.size() && steps_[coarser + 1].samples == steps_[step_].samples &&
         typical_ms_ * pixels(coarser) / pixels(step_) > budget_ms_) {
    ++coarser;
  }
  return coarser;
}

// Upper bound of the next finer step's time: a frame's time never grows faster than its number of pixels.
double DynamicResolution::finer_cost() const {
  const render::FrameQuality& now = steps_[step_];
  const render::FrameQuality& finer = steps_[step_ - 1];
  const double pixels = (finer.scale * finer.scale) / (now.scale * now.scale);
  return typical_ms_ * pixels * (finer.samples > now.samples ? kFourSamplesCost : 1.0);
}

bool DynamicResolution::add(double frame_ms) {
  if (recent_ms_.size() == kJudgedFrames) recent_ms_.erase(recent_ms_.begin());
  recent_ms_.push_back(frame_ms);
  if (recent_ms_.size() < kJudgedFrames) return false;
  std::array<double, kJudgedFrames> sorted{};
  std::copy(recent_ms_.begin(), recent_ms_.end(), sorted.begin());
  std::sort(sorted.begin(), sorted.end());
  typical_ms_ = sorted[kJudgedFrames / 2];

  if (typical_ms_ > budget_ms_) {
    steady_frames_ = 0;
    if (step_ + 1 == steps_.size()) return false;
    if (trying_) patience_frames_ = std::min(2 * patience_frames_, kMostPatienceFrames);
    return go(coarser_step());
  }
  ++steady_frames_;
  if (trying_ && steady_frames_ == patience_frames_) {  // steady since the step
    patience_frames_ = kPatienceFrames;
    trying_ = false;
  }
  if (step_ == 0 || steady_frames_ < patience_frames_ || finer_cost() > kRoom * budget_ms_) return false;
  return go(step_ - 1);
}

std::string DynamicResolution::text() const {
  std::string text = fmt::format("{:.0f} % of the pixels each way, {} sample{}", 100.0 * quality().scale,
                                 quality().samples, quality().samples == 1 ? "" : "s");
  if (over_budget()) text += fmt::format(", and still {:.0f} ms", typical_ms_);
  return text;
}

void DynamicResolution::rehearse(render::Renderer& renderer, const render::FrameState& frame) const {
  renderer.set_quality(steps_.back());
  renderer.render(frame);
  renderer.set_quality(quality());
}

void DynamicResolution::follow(render::Renderer& renderer) {
  const auto times = renderer.pass_times();
  if (!times || !add(times->total_ms())) return;
  renderer.set_quality(quality());
  core::log_line("frame budget: now drawing " + text());
}

render::DataRow DynamicResolution::row(const exhibit::Phrases& phrases) const {
  using enum exhibit::Phrase;
  const std::string budget = fmt::format("{:g} ms", budget_ms_);
  return {
      phrases[Picture],
      phrases.text<PictureQuality>(fmt::format("{:.0f}", 100.0 * quality().scale), std::to_string(quality().samples)),
      over_budget() ? phrases.text<PictureOverBudget>(fmt::format("{:.0f} ms", typical_ms_), budget)
                    : phrases.text<PictureBudget>(budget)};
}

void add_frame_budget(OptionList& command, std::optional<double>& budget_ms) {
  command
      .add_parsed_option(
          "--frame-budget",
          [&budget_ms](const std::string& text) -> core::Result<void> {
            double ms = 0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), ms);
            const bool number = error == std::errc() && end == text.data() + text.size();
            if (text != "none" && !(number && ms >= kLeastBudget_ms && ms <= kMostBudget_ms)) {
              return core::failure(core::ErrorCategory::WrongUsage,
                                   fmt::format("\"{}\" is not a frame budget; write {:g} to {:g} milliseconds, or none",
                                               text, kLeastBudget_ms, kMostBudget_ms));
            }
            budget_ms = text == "none" ? 0.0 : ms;
            return {};
          },
          fmt::format("time budget for drawing a frame, or none; slower frames get fewer pixels, down to half in each "
                      "direction, then one sample per pixel; panels keep all pixels; default: {:g} where the processor "
                      "draws, none on a GPU or with --eye-width",
                      kProcessorBudget_ms))
      .type_name("MS|none");
}

double frame_budget_ms(std::optional<double> given_ms, bool fixed_size, const render::Context& context) {
  return given_ms.value_or(fixed_size || !context.draws_on_processor() ? 0.0 : kProcessorBudget_ms);
}

}  // namespace afm::app
