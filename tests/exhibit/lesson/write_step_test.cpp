// SPDX-License-Identifier: Apache-2.0
// Lines that a lesson has a person write into a soft sample: what is judged, and when they are done.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

#include "exhibit/lesson/data_set.h"
#include "exhibit/lesson/lesson_run.h"
#include "exhibit/lesson/lesson_samples.h"
#include "exhibit/lesson/simulated_student.h"
#include "exhibit/state/lines_to_write.h"
#include "physics/manipulation/scratching_tip.h"
#include "scene/samples/material_library.h"
#include "scene/samples/particle_set.h"
#include "support/particles/particle_sets.h"
#include "support/particles/soft_sample.h"
#include "support/phrases.h"
#include "support/places.h"

namespace afm::exhibit {
namespace write_step_test {

using glm::dvec2;
using physics::EventKind;
using physics::Length;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using Wants = LessonPrompt::Wants;

constexpr double kNm = 1e-9, kHighM = 60 * kNm;
constexpr double kRightM = -50 * kNm;  // height of the base at which the groove is about 20 nm wide
const LinesToWrite kLine{.lines_m = {{dvec2(-80 * kNm, 0.0), dvec2(80 * kNm, 0.0)}}, .width_m = 20 * kNm};

// The soft sample of the shipped set under its tip.
class Sample {
 public:
  void stroke(const dvec2& from_m, const dvec2& to_m, double base_m = kRightM) {
    tip_.hold_over(base(from_m, kHighM));
    for (double z_m = kHighM; z_m > base_m; z_m -= 0.5 * kNm) tip_.move_to(base(from_m, z_m));
    const int steps = static_cast<int>(glm::distance(from_m, to_m) / (0.5 * kNm));
    for (int i = 0; i <= steps; ++i) tip_.move_to(base(glm::mix(from_m, to_m, 1.0 * i / steps), base_m));
    tip_.hold_over(base(to_m, kHighM));
  }

  std::vector<scene::MarkTile> tiles() const {
    std::vector<scene::MarkTile> tiles(scene::kMarkTiles);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      tip_.surface().copy_tile(i, tiles[i].pressed_m, tiles[i].back_m);
    }
    return tiles;
  }

  double width_m() const {
    return tip_.surface().section({Length(-80 * kNm), Length(0.0)}, {Length(80 * kNm), Length(0.0)}).width.si;
  }

 private:
  static physics::LeverBase base(const dvec2& at_m, double z_m) {
    return {{Length(at_m.x), Length(at_m.y)}, Length(z_m)};
  }

  scene::SharedParticles soft_ = test::soft_pmma();
  Length reach_{scene::soft_reach_m(soft_.pusher.tip_radius_m)};
  physics::ScratchingTip tip_{{Length(soft_.pusher.tip_radius_m), soft_.pusher.half_angle_rad},
                              {.lateral = physics::Stiffness(soft_.pusher.lateral_spring_n_per_m),
                               .normal = physics::Stiffness(soft_.pusher.normal_spring_n_per_m),
                               .contact = physics::Stiffness(1.0)},
                              scene::soft_surface(soft_.soft),
                              {-reach_, -reach_},
                              {reach_, reach_},
                              base({0.0, 0.0}, kHighM)};
};

class WriteStep : public ::testing::Test {
 protected:
  WriteStep() {
    lesson_.set = std::make_shared<const scene::ParticleSet>(test::particle_set("scratch-pmma"));
    lesson_.particles = "scratch-pmma";
    lesson_.scale = scene::ScaleMode::Particles;
    lesson_.id = "write";
    lesson_.materials = {"mica"};
    LessonStep step;
    step.kind = StepKind::Write;
    step.id = "line";
    step.lines = std::make_shared<const LinesToWrite>(kLine);
    step.words.texts = {"Write it.", "Schreiben Sie."};
    lesson_.steps = {step};
    samples_ = lesson_samples(lesson_, scene::load_materials(support::source("assets/materials.toml")).value()).value();
  }

  LessonRun run() {
    const auto keep = [this](const TrialRow& row) {
      rows_.push_back(row);
      return core::Result<void>{};
    };
    return LessonRun(lesson_, samples_, test::english(), {.seed = 3}, keep, 0.0);
  }

  // Adds a tick with the tip on the sample in its current state, or above it.
  void tick(LessonRun& run, bool on, HandForce force = HandForce::Full) {
    now_s_ += 1e-3;
    scene::TipSample sample;
    sample.tip.z_m = on ? kRightM : kHighM;
    sample.time_ns = static_cast<std::int64_t>(now_s_ * 1e9);
    sample.push.digest = scene::digest_of(tiles_);
    sample.push.state = on ? physics::PushState::Slides : physics::PushState::Free;
    if (on) sample.push.lateral_n = {-20e-9, 0.0};
    run.force_is(force, now_s_);
    run.add(sample, now_s_);
  }
  void lift(LessonRun& run) {
    for (int i = 0; i < 700; ++i) tick(run, false);
    run.look_at_marks(tiles_, now_s_);
  }
  void stroke(LessonRun& run, const dvec2& from_m, const dvec2& to_m, double base_m = kRightM,
              HandForce force = HandForce::Full) {
    tick(run, false);
    tick(run, true, force);
    surface_.stroke(from_m, to_m, base_m);
    tiles_ = surface_.tiles();
    tick(run, true);
    lift(run);
  }
  void stroke_line(LessonRun& run, double base_m = kRightM, HandForce force = HandForce::Full) {
    stroke(run, kLine.lines_m[0][0], kLine.lines_m[0][1], base_m, force);
  }
  void level(LessonRun& run, EventKind event) {
    surface_ = Sample();
    tiles_ = surface_.tiles();
    run.add(scene::TipEvent{.kind = event});
    lift(run);
  }

  Lesson lesson_;
  std::vector<curves::SampleModel> samples_;
  Sample surface_;
  std::vector<scene::MarkTile> tiles_ = std::vector<scene::MarkTile>(scene::kMarkTiles);
  std::vector<TrialRow> rows_;
  double now_s_ = 0;
};

TEST_F(WriteStep, IsDoneOnceTheLineIsWrittenAndTheTipIsLifted) {
  auto run = this->run();
  tick(run, false);
  EXPECT_EQ(run.prompt(now_s_).wants, Wants::Write);
  EXPECT_FALSE(run.prompt(now_s_).put_back);
  ASSERT_NE(run.prompt(now_s_).lines, nullptr);
  EXPECT_EQ(run.prompt(now_s_).words, "Write it.");
  stroke(run, {-80 * kNm, 0.0}, {10 * kNm, 0.0});
  EXPECT_FALSE(run.end());
  EXPECT_THAT(run.prompt(now_s_).words, StartsWith("Not done: 6")) << "62 % or so";
  EXPECT_THAT(run.prompt(now_s_).words,
              EndsWith("% of the lines are written. Write the rest, and lift the tip. Write it."));
  stroke(run, {-10 * kNm, 0.0}, {80 * kNm, 0.0});
  ASSERT_EQ(run.end(), LessonEnd::Finished) << run.prompt(now_s_).words;
  ASSERT_EQ(rows_.size(), 1U);
  EXPECT_LT(std::stod(rows_[0].response), 1e-9);
  EXPECT_EQ(rows_[0].stimulus, "");
  EXPECT_EQ(rows_[0].force, true);
  EXPECT_EQ(rows_[0].push.value().strokes, 2U);
  EXPECT_EQ(rows_[0].push->undos, 0U);
  EXPECT_NEAR(*rows_[0].rt_s, 0.703, 0.01) << "from the first stroke to the last lift";
  EXPECT_THAT(line_of(rows_[0]), HasSubstr("\twrite\t"));
  EXPECT_THAT(line_of(rows_[0]), EndsWith("\t20\ttruth\n"));
}

TEST_F(WriteStep, GivesTheDistanceOfTheGrooveFromTheLine) {
  auto run = this->run();
  stroke(run, {-80 * kNm, 8 * kNm}, {80 * kNm, 8 * kNm});
  ASSERT_EQ(run.end(), LessonEnd::Finished) << run.prompt(now_s_).words;
  EXPECT_NEAR(std::stod(rows_[0].response), 8e-9, 0.5e-9);
}

TEST_F(WriteStep, SaysWhatIsWrongAndCountsWhatIsTakenBack) {
  auto run = this->run();
  stroke_line(run, -16 * kNm);
  EXPECT_THAT(run.prompt(now_s_).words, StartsWith("Not done: the groove is "));
  EXPECT_THAT(run.prompt(now_s_).words, HasSubstr("wide instead of 20 nm. Go over it again and press harder."));
  stroke_line(run, -115 * kNm);
  EXPECT_THAT(run.prompt(now_s_).words, HasSubstr("wide instead of 20 nm. Backspace takes a stroke back"));
  level(run, EventKind::ParticlesPutBack);
  EXPECT_EQ(run.prompt(now_s_).words, "Write it.") << "there is nothing to judge";
  EXPECT_FALSE(run.prompt(now_s_).put_back) << "the trial goes on";
  stroke_line(run);
  ASSERT_EQ(run.end(), LessonEnd::Finished) << run.prompt(now_s_).words;
  EXPECT_EQ(rows_.size(), 1U);
  EXPECT_EQ(rows_[0].push.value().strokes, 3U);
  EXPECT_EQ(rows_[0].push->undos, 1U);
  EXPECT_THAT(line_of(rows_[0]), EndsWith("\ttruth+undo\n"));
}

TEST_F(WriteStep, AllowsNoMarkFartherThanTwoWidths) {
  auto run = this->run();
  stroke(run, {0.0, 30 * kNm}, {20 * kNm, 30 * kNm});
  EXPECT_THAT(run.prompt(now_s_).words, Not(HasSubstr("from the lines"))) << "within 40 nm";
  stroke(run, {0.0, 60 * kNm}, {20 * kNm, 60 * kNm});
  EXPECT_THAT(run.prompt(now_s_).words, StartsWith("Not done: there are marks more than 40 nm from the lines."));
  stroke_line(run);
  EXPECT_FALSE(run.end());
}

TEST_F(WriteStep, MeasuresTheWidthAsTheSurfaceDoes) {
  for (const double base_m : {-16 * kNm, -115 * kNm}) {
    surface_ = Sample();
    tiles_ = surface_.tiles();
    auto run = this->run();
    stroke_line(run, base_m);
    const std::string words = run.prompt(now_s_).words, before = "the groove is ";
    EXPECT_NEAR(std::stod(words.substr(words.find(before) + before.size())), surface_.width_m() / kNm, 1.0) << words;
  }
}

TEST_F(WriteStep, WaitsUntilTheSampleIsLevel) {
  surface_.stroke({0.0, 0.0}, {20 * kNm, 0.0});
  tiles_ = surface_.tiles();
  auto run = this->run();
  lift(run);
  EXPECT_TRUE(run.prompt(now_s_).put_back);
  level(run, EventKind::ParticlesPutBack);
  EXPECT_FALSE(run.prompt(now_s_).put_back);
}

TEST_F(WriteStep, BeginsAgainIfItWasNotFeltWhileTheTipTouchedTheSample) {
  auto run = this->run();
  stroke_line(run, kRightM, HandForce::Reduced);
  EXPECT_FALSE(run.end());
  ASSERT_EQ(rows_.size(), 1U) << "the attempt is kept";
  EXPECT_EQ(rows_[0].force, false);
  EXPECT_EQ(rows_[0].response, "");
  EXPECT_TRUE(run.prompt(now_s_).put_back);
  EXPECT_THAT(run.prompt(now_s_).words, StartsWith("This writing does not count: the force was weaker"));
  level(run, EventKind::ParticlesPutBack);
  stroke_line(run);
  EXPECT_EQ(run.end(), LessonEnd::Finished) << run.prompt(now_s_).words;
  EXPECT_EQ(rows_.back().push.value().undos, 0U) << "the lesson made it level";
}

TEST_F(WriteStep, IsManagedByASimulatedStudentWithDelayAndTremorAlikeForASeed) {
  lesson_.steps[0].lines = std::make_shared<const LinesToWrite>(
      LinesToWrite{.lines_m = {{dvec2(-80 * kNm, 80 * kNm), dvec2(80 * kNm, 80 * kNm)},
                               {dvec2(0.0, 80 * kNm), dvec2(0.0, -80 * kNm)}},
                   .width_m = 20 * kNm});
  std::vector<std::string> lines;
  for (int i = 0; i < 2; ++i) {
    rows_.clear();
    auto run = this->run();
    SimulatedStudent student({.seed = 5, .abilities = {}}, lesson_, samples_);
    const auto taken = student.take(run);
    ASSERT_TRUE(taken) << taken.error().message;
    ASSERT_EQ(rows_.size(), 1U) << "the writing was felt";
    EXPECT_LT(std::stod(rows_[0].response), 5e-9);
    EXPECT_GT(std::stod(rows_[0].response), 0.0);
    EXPECT_EQ(rows_[0].push.value().strokes, 2U);
    EXPECT_EQ(rows_[0].push->undos, 0U);
    EXPECT_GT(rows_[0].push->work_j, 0.0);
    lines.push_back(line_of(rows_[0]));
  }
  EXPECT_EQ(lines[0], lines[1]);
}

}  // namespace write_step_test
}  // namespace afm::exhibit
