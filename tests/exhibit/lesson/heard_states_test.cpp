// SPDX-License-Identifier: Apache-2.0
// The lesson "Two states", taken by a learner that hears the mixer's samples and sees, feels and is given nothing else.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "exhibit/lesson/lesson_file.h"
#include "exhibit/lesson/lesson_run.h"
#include "exhibit/lesson/lesson_samples.h"
#include "exhibit/sound/pitch.h"
#include "exhibit/sound/sound_mixer.h"
#include "haptics/contact_model.h"
#include "haptics/simulated_device.h"
#include "scene/samples/material_library.h"
#include "support/phrases.h"
#include "support/places.h"
#include "support/sound_analysis.h"

namespace afm::exhibit {
namespace heard_states_test {

using Wants = LessonPrompt::Wants;

constexpr double kTickS = 1e-3;
constexpr double kHandMPerS = 0.01;
constexpr std::size_t kHeardSamples = 4096;  // 85 ms, enough for a learner to hear the pitch

class DeafOrNot : public ::testing::TestWithParam<bool> {
 protected:
  DeafOrNot()
      : lesson_(load_lesson(support::source("assets/lessons/two-states.toml"), support::source("assets")).value()),
        samples_(
            lesson_samples(lesson_, scene::load_materials(support::source("assets/materials.toml")).value()).value()) {
    const haptics::DeviceSpec hand = haptics::SimulatedDevice().spec();
    const auto common = haptics::Scaling::common_scale(std::vector{samples_[0].tables}, hand);
    model_ = haptics::ContactModel::create(samples_[0].parameters, 0, samples_[0].tables, {}, *common, hand, 1'000'000)
                 .value();
    mixer_.set_ear(0, Ear(*samples_[0].tables, samples_[0].parameters.free_amplitude_m));
    mixer_.set_tones(GetParam());
  }

  // A cycle of the hand, from above both states to the surface and back; ends where the lesson asks.
  void move(LessonRun& run) {
    const double high_m = model_->scaling().hand_height_m(24e-9), low_m = model_->scaling().hand_height_m(14e-9);
    const auto ticks = static_cast<int>((high_m - low_m) / (kHandMPerS * kTickS));
    run.force_is(HandForce::Full, now_s_);
    for (int i = -ticks; i <= ticks; ++i) {
      tick(run, low_m + (high_m - low_m) * std::abs(i) / ticks);
      if (run.prompt(now_s_).wants != Wants::Cycle) return;
    }
  }

  void tick(LessonRun& run, double height_m) {
    now_s_ += kTickS;
    const haptics::Touch touch = model_->step({0.0, 0.0, height_m});
    scene::TipSample sample;
    sample.time_ns = static_cast<std::int64_t>(now_s_ * 1e9);
    sample.material = 0;
    sample.servo_state = scene::ServoState::Running;
    sample.phase = touch.response.phase;
    sample.tip.z_m = touch.z_m;
    sample.tip.force_n = touch.response.force.si;
    sample.swing = touch.swing;
    mixer_.heard(sample);
    for (std::uint32_t i = 0; i < touch.response.event_count; ++i) {
      const physics::ModelEvent& event = touch.response.events[i];
      run.happened({.kind = event.kind, .material = 0, .time_ns = sample.time_ns, .z_m = event.z.si}, now_s_);
    }
    run.add(sample, now_s_);
    std::vector<float> block(2 * static_cast<std::size_t>(kTickS * kSoundRateHz));
    mixer_.fill(block, sample.time_ns);
    for (std::size_t i = 0; i < block.size(); i += 2) heard_.push_back(static_cast<double>(block[i]));
  }

  // The state by its newest tone: higher than A, attractive; lower, repulsive. Silence: a guess.
  std::size_t state_by_ear() const {
    const std::span<const double> newest = std::span(heard_).last(kHeardSamples);
    if (test::rms(newest) < 1e-6) return 0;
    return test::pitch_hz(newest, kSoundRateHz) > 440.0 ? 0 : 1;
  }

  Lesson lesson_;
  std::vector<curves::SampleModel> samples_;
  std::unique_ptr<haptics::ContactModel> model_;
  SoundMixer mixer_{Channels::Mono};
  std::vector<double> heard_;
  double now_s_ = 1.0;
};

TEST_P(DeafOrNot, NamesTheStateBlindByItsToneAndIsScored) {
  const bool hears = GetParam();
  std::vector<TrialRow> rows;
  LessonRun run(
      lesson_, samples_, test::english(), {.seed = 15},
      [&](const TrialRow& row) {
        rows.push_back(row);
        return core::Result<void>{};
      },
      now_s_);
  int blind = 0;
  while (!run.end()) {
    const LessonPrompt prompt = run.prompt(now_s_);
    if (prompt.wants == Wants::GoOn) {
      run.go_on(now_s_ += 1.0);
    } else if (prompt.wants == Wants::Answer) {
      blind += prompt.hidden ? 1 : 0;
      run.answer(prompt.hidden ? state_by_ear() : 0, now_s_ += 0.5);
    } else {
      ASSERT_EQ(prompt.wants, Wants::Cycle);
      move(run);
    }
    ASSERT_LT(now_s_, 3600.0);
  }
  EXPECT_EQ(run.end(), LessonEnd::Finished);
  int named = 0, right = 0, repulsive = 0;
  for (const TrialRow& row : rows) {
    if (row.stimulus != "attractive" && row.stimulus != "repulsive") continue;
    ++named;
    repulsive += row.stimulus == "repulsive" ? 1 : 0;
    ASSERT_TRUE(row.correct.has_value());
    right += *row.correct ? 1 : 0;
  }
  EXPECT_EQ(blind, 10) << "four before, two to practise and four after";
  EXPECT_EQ(named, 10);
  EXPECT_EQ(right, hears ? named : named - repulsive);
  EXPECT_GE(repulsive, 4);
}

INSTANTIATE_TEST_SUITE_P(Learners, DeafOrNot, ::testing::Bool(),
                         [](const auto& learner) { return learner.param ? "WhoHears" : "WhoIsDeaf"; });

}  // namespace heard_states_test
}  // namespace afm::exhibit
