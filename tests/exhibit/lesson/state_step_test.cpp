// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "exhibit/lesson/lesson_run.h"
#include "exhibit/lesson/lesson_samples.h"
#include "scene/samples/material_library.h"
#include "support/phrases.h"
#include "support/places.h"
#include "support/samples/tapped_sample.h"

namespace afm::exhibit {
namespace state_step_test {

using Wants = LessonPrompt::Wants;

// A hand that moves a swing through the heights at which both states exist.
class StatesOfASwing : public ::testing::Test {
 protected:
  StatesOfASwing() {
    lesson_.title.texts = {"Test", "Test"};
    lesson_.materials = {"mica"};
    lesson_.tapping = std::make_shared<const curves::TappedHand>(test::tapped_hand());
    samples_ = lesson_samples(lesson_, scene::load_materials(support::source("assets/materials.toml")).value()).value();
    LessonStep step;
    step.id = "name";
    step.kind = StepKind::Identify;
    step.words.texts = {"Do this.", "Tu das."};
    step.materials = {0};
    step.states = true;
    step.trials = 4;
    lesson_.steps = {step};
  }

  LessonRun run() {
    return LessonRun(
        lesson_, samples_, test::english(), {.seed = 7},
        [this](const TrialRow& row) {
          rows_.push_back(row);
          return core::Result<void>{};
        },
        0.0);
  }
  static scene::TipEvent jump(physics::EventKind kind) {
    scene::TipEvent event;
    event.kind = kind;
    event.material = 0;
    return event;
  }
  // Down from above both folds, or up from below them.
  void pass(LessonRun& run, physics::Phase phase, HandForce force) {
    const physics::CycleFigures& figures = samples_[0].figures();
    const double low_m = figures.z_jtc.si, high_m = figures.z_joc.si;
    const bool down = phase == physics::Phase::Free;
    run.force_is(force, now_s_);
    for (int i = 0; i <= 10; ++i) {
      scene::TipSample sample;
      sample.time_ns = static_cast<std::int64_t>((now_s_ += 0.01) * 1e9);
      sample.material = 0;
      sample.phase = phase;
      sample.tip.z_m = (down ? high_m : low_m) + (down ? -0.1 : 0.1) * i * (high_m - low_m);
      run.add(sample, now_s_);
    }
  }

  Lesson lesson_;
  std::vector<curves::SampleModel> samples_;
  std::vector<TrialRow> rows_;
  double now_s_ = 1.0;
};

TEST_F(StatesOfASwing, AreAskedForInTheDrawnStateAloneAndJudged) {
  auto run = this->run();
  std::map<std::string, int> shown;
  for (int i = 0; i < 4; ++i) {
    const LessonPrompt trial = run.prompt(now_s_);
    ASSERT_EQ(trial.wants, Wants::Cycle);
    EXPECT_TRUE(trial.hidden && trial.of_states);
    const bool repulsive = trial.right == 1;
    const auto wanted = repulsive ? physics::Phase::Attached : physics::Phase::Free;
    const auto other = repulsive ? physics::Phase::Free : physics::Phase::Attached;
    pass(run, other, HandForce::Full);
    EXPECT_EQ(run.prompt(now_s_).wants, Wants::Cycle) << "of the other state nothing is asked";
    pass(run, wanted, HandForce::None);
    EXPECT_EQ(run.prompt(now_s_).wants, Wants::Cycle) << "without the force nothing was felt";
    run.force_is(HandForce::Full, now_s_);
    if (repulsive) run.happened(jump(physics::EventKind::JumpToRepulsion), now_s_);
    pass(run, wanted, HandForce::Full);
    const LessonPrompt question = run.prompt(now_s_);
    ASSERT_EQ(question.wants, Wants::Answer);
    EXPECT_EQ(question.answers, (std::vector<std::string>{"attractive", "repulsive"}));
    run.force_is(HandForce::None, now_s_);  // the lesson takes it while it asks
    EXPECT_EQ(run.prompt(now_s_).wants, Wants::Answer);
    run.answer(i == 0 ? 1 - question.right : question.right, now_s_ + 0.5);
    const TrialRow& row = rows_.back();
    ++shown[row.stimulus];
    EXPECT_EQ(row.stimulus, repulsive ? "repulsive" : "attractive");
    EXPECT_EQ(*row.correct, i > 0);
    EXPECT_EQ(row.response == row.stimulus, i > 0);
    EXPECT_TRUE(row.force && *row.force);
    EXPECT_LT(*row.rt_s, 0.7);
  }
  EXPECT_EQ(rows_.size(), 4U);
  EXPECT_EQ(shown, (std::map<std::string, int>{{"attractive", 2}, {"repulsive", 2}}));
  EXPECT_EQ(run.end(), LessonEnd::Finished);
}

// Two cycles of a swing end a free exploration as those of a resting tip do.
TEST_F(StatesOfASwing, ChangeOnceEachWayInACycle) {
  lesson_.steps[0].kind = StepKind::Free;
  lesson_.steps[0].trials = 2;
  auto run = this->run();
  run.force_is(HandForce::Full, 1);
  run.happened(jump(physics::EventKind::JumpToAttraction), 1);  // no cycle, since the swing never became repulsive
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(run.end(), std::nullopt);
    run.happened(jump(physics::EventKind::JumpToRepulsion), 2 + i);
    run.happened(jump(physics::EventKind::JumpToAttraction), 3 + i);
  }
  EXPECT_EQ(run.end(), LessonEnd::Finished);
}

}  // namespace state_step_test
}  // namespace afm::exhibit
