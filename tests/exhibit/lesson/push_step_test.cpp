// SPDX-License-Identifier: Apache-2.0
// A lesson counts a push only if the full force was on the hand while the tip touched a particle.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "exhibit/lesson/data_set.h"
#include "exhibit/lesson/lesson_run.h"
#include "exhibit/lesson/lesson_samples.h"
#include "exhibit/lesson/simulated_student.h"
#include "scene/samples/material_library.h"
#include "support/particles/particle_sets.h"
#include "support/phrases.h"
#include "support/places.h"

namespace afm::exhibit {
namespace push_step_test {

using ::testing::EndsWith;
using ::testing::StartsWith;
using Wants = LessonPrompt::Wants;
using physics::EventKind;

constexpr double kHighM = 1e-7, kWayM = 80e-9;

class PushStep : public ::testing::Test {
 protected:
  PushStep() {
    lesson_.id = "push";
    lesson_.title.texts = {"Push", "Schieben"};
    lesson_.materials = {"mica"};
    lesson_.scale = scene::ScaleMode::Particles;
    lesson_.particles = "gold-row";
    lesson_.set = std::make_shared<const scene::ParticleSet>(test::particle_set("gold-row"));
    samples_ = lesson_samples(lesson_, scene::load_materials(support::source("assets/materials.toml")).value()).value();
    pages_ = test::start_pages(*lesson_.set);
  }

  LessonRun run(const PushPlan& plan, const PushPlan& next) {
    lesson_.steps = {step_of(plan), step_of(next)};
    return begun(test::english());
  }
  LessonRun run(const PushPlan& plan, std::optional<Condition> condition = std::nullopt,
                const Phrases& phrases = test::english()) {
    LessonStep step = step_of(plan);
    step.each_condition = condition.has_value();
    lesson_.steps = {step};
    lesson_.conditions.clear();
    if (condition) lesson_.conditions = {*condition};
    return begun(phrases);
  }
  static LessonStep step_of(const PushPlan& plan) {
    LessonStep step;
    step.id = "push";
    step.kind = StepKind::Push;
    step.words.texts = {"Push it.", "Schieben Sie."};
    step.push = plan;
    return step;
  }
  LessonRun begun(const Phrases& phrases) {
    return LessonRun(
        lesson_, samples_, phrases, {.seed = 3},
        [this](const TrialRow& row) {
          rows_.push_back(row);
          return core::Result<void>{};
        },
        0.0);
  }

  // A tick in which the tip touches the particle, or none.
  void tick(LessonRun& run, HandForce force, std::int32_t particle, double height_m) {
    now_s_ += 1e-3;
    scene::TipSample sample;
    sample.time_ns = static_cast<std::int64_t>(now_s_ * 1e9);
    sample.tip.z_m = height_m;
    sample.push.particle = particle;
    sample.push.lateral_n = {particle < 0 ? 0.0 : 0.2e-9, 0.0};
    sample.push.digest = scene::digest_of(pages_, lesson_.set->particles.size());
    run.force_is(force, now_s_);
    run.add(sample, now_s_);
  }
  void lift(LessonRun& run) {
    for (int i = 0; i < 700; ++i) tick(run, HandForce::Full, scene::kNoParticle, kHighM);
    run.look(pages_, now_s_);
  }
  // Pushes the first particle so far, and lifts.
  void push(LessonRun& run, double way_m, HandForce force = HandForce::Full) {
    run.look(pages_, now_s_);
    tick(run, HandForce::Full, scene::kNoParticle, kHighM);
    tick(run, force, 0, 0.0);
    pages_[0].poses[0].x_m += way_m;
    tick(run, HandForce::Full, 0, 0.0);
    lift(run);
  }

  Lesson lesson_;
  std::vector<curves::SampleModel> samples_;
  std::vector<scene::ParticlePage> pages_;
  std::vector<TrialRow> rows_;
  double now_s_ = 0;
};

constexpr PushPlan kMoved{.until = PushUntil::Moved, .particle = 0, .target = 0, .distance_m = kWayM};

TEST_F(PushStep, IsDoneOnceTheParticleIsFarEnoughAndTheTipIsLifted) {
  auto run = this->run(kMoved);
  EXPECT_EQ(run.prompt(0).wants, Wants::Push);
  push(run, 0.6 * kWayM);
  EXPECT_FALSE(run.end()) << "too short";
  push(run, 0.5 * kWayM);
  ASSERT_EQ(run.end(), LessonEnd::Finished);
  ASSERT_EQ(rows_.size(), 1U);
  const TrialRow& row = rows_[0];
  EXPECT_EQ(row.stimulus, "moved");
  EXPECT_NEAR(std::stod(row.response), 1.1 * kWayM, 1e-12);
  EXPECT_EQ(row.force, true);
  ASSERT_TRUE(row.push);
  EXPECT_EQ(row.push->strokes, 2U);
  EXPECT_EQ(row.push->losses, 0U);
  EXPECT_NEAR(row.push->largest_lateral_n, 0.2e-9, 1e-15);
  EXPECT_NEAR(*row.rt_s, 0.703, 0.01) << "from the first push to the last lift";
  EXPECT_THAT(line_of(row), EndsWith("\t1\t2\t0\t0\t0\t0.2\ttruth\n"));
}

TEST_F(PushStep, IsDarkFromTheFirstTouchUntilABlindPushIsDone) {
  auto run = this->run(PushPlan{.until = PushUntil::Line, .particle = 0, .target = 1});
  run.look(pages_, now_s_);
  EXPECT_FALSE(run.prompt(now_s_).dark) << "before the first touch";
  tick(run, HandForce::Full, scene::kNoParticle, kHighM);
  tick(run, HandForce::Full, 0, 0.0);
  EXPECT_TRUE(run.prompt(now_s_).dark);
  EXPECT_FALSE(run.prompt(now_s_).hidden) << "with tones";
  EXPECT_FALSE(run.prompt(now_s_).far_enough);
  pages_[0].poses[0].x_m += 110e-9;  // end of the line, which is 100 nm long
  pages_[0].poses[0].y_m -= 3e-9;
  tick(run, HandForce::Full, 0, 0.0);
  run.look(pages_, now_s_);
  EXPECT_TRUE(run.prompt(now_s_).far_enough);
  lift(run);
  ASSERT_EQ(run.end(), LessonEnd::Finished);
  EXPECT_EQ(rows_.at(0).stimulus, "line");
  EXPECT_NEAR(std::stod(rows_[0].response), 3e-9, 1e-14);
  EXPECT_THAT(line_of(rows_[0]), EndsWith("\tn/a\n")) << "no aid";
}

TEST_F(PushStep, IsDarkAndSilentWhileAThresholdIsFelt) {
  lesson_.set = std::make_shared<const scene::ParticleSet>(test::particle_set("threshold-by-feel"));
  pages_ = test::start_pages(*lesson_.set);
  auto run = this->run(PushPlan{.until = PushUntil::Threshold, .particle = 0});
  run.look(pages_, now_s_);
  tick(run, HandForce::Full, scene::kNoParticle, kHighM);
  run.add(scene::TipEvent{.kind = EventKind::ParticleGave, .force_before_n = 0.25e-9});
  pages_[0].poses[0].x_m += 30e-9;
  tick(run, HandForce::Full, 0, 0.0);
  EXPECT_TRUE(run.prompt(now_s_).dark && run.prompt(now_s_).hidden);
  lift(run);
  EXPECT_FALSE(run.end()) << "no answer yet";
  for (int i = 0; i < 1200; ++i) tick(run, HandForce::Full, 1, 0.0);  // force of 0.2 nN
  lift(run);
  ASSERT_EQ(run.end(), LessonEnd::Finished);
  EXPECT_EQ(rows_.at(0).stimulus, "threshold");
  EXPECT_NEAR(std::stod(rows_[0].response), 0.8, 1e-6);
}

TEST_F(PushStep, WaitsUntilAllParticlesAreAtTheirStart) {
  pages_[0].poses[2].x_m += 1e-12;
  auto run = this->run(kMoved);
  run.look(pages_, 1);
  EXPECT_TRUE(run.prompt(1).put_back);
  pages_ = test::start_pages(*lesson_.set);
  run.look(pages_, 2);
  EXPECT_FALSE(run.prompt(2).put_back);
}

TEST_F(PushStep, BeginsAgainIfItWasNotFeltWhileTheTipTouchedAParticle) {
  for (const HandForce less : {HandForce::None, HandForce::Changing, HandForce::Reduced}) {
    rows_.clear();
    pages_ = test::start_pages(*lesson_.set);
    auto run = this->run(kMoved);
    push(run, 1.2 * kWayM, less);
    EXPECT_FALSE(run.end());
    ASSERT_EQ(rows_.size(), 1U) << "the attempt is kept";
    EXPECT_EQ(rows_[0].force, false);
    EXPECT_EQ(rows_[0].response, "");
    EXPECT_TRUE(run.prompt(now_s_).put_back);
    EXPECT_THAT(run.prompt(now_s_).words, StartsWith("That push does not count: the force was "));
    EXPECT_THAT(run.prompt(now_s_).words, EndsWith(" Push it."));
    pages_ = test::start_pages(*lesson_.set);
    push(run, 1.2 * kWayM);
    EXPECT_EQ(run.end(), LessonEnd::Finished);
    EXPECT_EQ(rows_.back().force, true);
    EXPECT_EQ(rows_.back().push->strokes, 1U) << "of the felt attempt alone";
  }
}

TEST_F(PushStep, NeedsNoForceWhileTheTipIsAboveTheParticles) {
  auto run = this->run(kMoved);
  push(run, 0.6 * kWayM);
  for (int i = 0; i < 10; ++i) tick(run, HandForce::None, scene::kNoParticle, kHighM);
  push(run, 0.6 * kWayM);
  EXPECT_EQ(run.end(), LessonEnd::Finished);
}

TEST_F(PushStep, SaysInGermanTooThatItDoesNotCount) {
  const auto german = Phrases::load(support::source("assets/guidance/de.toml"));
  ASSERT_TRUE(german);
  auto run = this->run(kMoved, std::nullopt, *german);
  push(run, kWayM, HandForce::None);
  EXPECT_THAT(run.prompt(now_s_).words, StartsWith("Dieser Schub zählt nicht"));
}

TEST_F(PushStep, IsDoneByTheWantedLossAloneAndAtOnce) {
  auto run = this->run({.until = PushUntil::Lost, .particle = 0});
  const auto lose = [&](std::int32_t particle) {
    run.look(pages_, now_s_);
    tick(run, HandForce::Full, particle, 0.0);
    pages_[0].poses[0].x_m += 1e-8;
    tick(run, HandForce::Full, particle, 0.0);
    run.add(scene::TipEvent{.kind = EventKind::ParticleLost});
    tick(run, HandForce::Full, scene::kNoParticle, 0.0);
    run.look(pages_, now_s_);
  };
  lose(1);
  EXPECT_FALSE(run.end()) << "another particle";
  lose(0);
  ASSERT_EQ(run.end(), LessonEnd::Finished);
  EXPECT_NEAR(std::stod(rows_.back().response), 2e-8, 1e-14);
  EXPECT_EQ(rows_.back().push->losses, 2U);
}

TEST_F(PushStep, IsJudgedByTheTaskOfThePattern) {
  auto run = this->run({.until = PushUntil::Pattern});
  push(run, kWayM);
  EXPECT_FALSE(run.end());
  tick(run, HandForce::Full, 0, 0.0);
  pages_ = test::formed_pages(*lesson_.set);
  tick(run, HandForce::Full, 0, 0.0);
  lift(run);
  ASSERT_EQ(run.end(), LessonEnd::Finished);
  EXPECT_NEAR(std::stod(rows_.back().response), 0.9 * 25e-9, 1e-12);
}

TEST_F(PushStep, ToATargetIsJudgedByItsParticleAlone) {
  const auto targets = scene::shared_targets(*lesson_.set);
  auto run = this->run({.until = PushUntil::Target, .particle = 0, .target = 1});
  run.look(pages_, now_s_);
  tick(run, HandForce::Full, 1, 0.0);
  pages_[0].poses[1].x_m = targets[1].position.x.si;
  pages_[0].poses[1].y_m = targets[1].position.y.si;
  tick(run, HandForce::Full, 1, 0.0);
  lift(run);
  EXPECT_FALSE(run.end()) << "another particle lies on the target";
  push(run, targets[1].position.x.si + 5e-9 - pages_[0].poses[0].x_m);
  ASSERT_EQ(run.end(), LessonEnd::Finished);
  EXPECT_NEAR(std::stod(rows_.back().response), 5e-9, 1e-12);
}

TEST_F(PushStep, NotesTheAidsThatWereUsed) {
  auto blind = this->run(kMoved, Condition::Haptics);
  push(blind, 0.1 * kWayM);
  blind.add(scene::TipEvent{.kind = EventKind::PushTakenBack});
  pages_ = test::start_pages(*lesson_.set);
  lift(blind);
  push(blind, 1.1 * kWayM);
  ASSERT_EQ(blind.end(), LessonEnd::Finished);
  EXPECT_EQ(rows_.back().push->undos, 1U);
  EXPECT_THAT(line_of(rows_.back()), EndsWith("\tundo\n")) << "a blank picture shows no truth";
}

TEST_F(PushStep, IsManagedByASimulatedStudentWithDelayAndTremorAlikeForASeed) {
  std::vector<std::string> lines;
  for (int i = 0; i < 2; ++i) {
    rows_.clear();
    auto run = this->run({.until = PushUntil::Moved, .particle = 0, .target = 0, .distance_m = 60e-9},
                         {.until = PushUntil::Lost, .particle = 0});
    SimulatedStudent student({.seed = 5, .abilities = {}}, lesson_, samples_);
    const auto taken = student.take(run);
    ASSERT_TRUE(taken) << taken.error().message;
    ASSERT_EQ(rows_.size(), 2U) << "every push was felt";
    EXPECT_GE(std::stod(rows_[0].response), 60e-9);
    EXPECT_EQ(rows_[0].force, true);
    EXPECT_GE(rows_[1].push->losses, 1U);
    EXPECT_GT(rows_[0].push->work_j, 0.0);
    for (const TrialRow& row : rows_) lines.push_back(line_of(row));
  }
  EXPECT_EQ(lines[0] + lines[1], lines[2] + lines[3]);
}

}  // namespace push_step_test
}  // namespace afm::exhibit
