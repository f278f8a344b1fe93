// SPDX-License-Identifier: Apache-2.0
// Lines that a lesson has a person write with ink: what is judged, and that a simulated student writes them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "exhibit/lesson/data_set.h"
#include "exhibit/lesson/lesson_run.h"
#include "exhibit/lesson/lesson_samples.h"
#include "exhibit/lesson/simulated_student.h"
#include "exhibit/state/lines_to_write.h"
#include "physics/manipulation/ink.h"
#include "scene/samples/ink_run.h"
#include "scene/samples/material_library.h"
#include "scene/samples/particle_set.h"
#include "scene/shared/soft_blocks.h"
#include "support/particles/particle_sets.h"
#include "support/phrases.h"
#include "support/places.h"

namespace afm::exhibit {
namespace write_ink_step_test {

using glm::dvec2;
using physics::Length;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kNm = 1e-9;
const LinesToWrite kLine{.lines_m = {{dvec2(-300 * kNm, 0.0), dvec2(300 * kNm, 0.0)}}, .width_m = 80 * kNm};

class WriteInkStep : public ::testing::Test {
 protected:
  WriteInkStep() : ink_(set_->ink->ink), surface_(bare()) {
    lesson_.set = set_;
    lesson_.particles = "write-ink";
    lesson_.scale = scene::ScaleMode::Particles;
    lesson_.id = "ink";
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

  physics::InkedSurface bare() const {
    const Length reach(scene::ink_reach_m(ink_));
    return {ink_, {-reach, -reach}, {reach, reach}, Length(0.0), Length(scene::ink_side_m(ink_) / scene::kSoftSide)};
  }
  void publish() {
    std::vector<scene::MarkTile> tiles(scene::kMarkTiles);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      std::array<std::uint8_t, physics::InkedSurface::kTileSquares> covered{};
      surface_.copy_tile(i, covered);
      for (std::size_t at = 0; at < covered.size(); ++at) {
        tiles[i].pressed_m[at] = covered[at] != 0 ? set_->ink->thickness.si : 0.0;
      }
    }
    tiles_ = tiles;
    digest_ = scene::digest_of(tiles_);
  }

  void tick(LessonRun& run, bool on) {
    now_s_ += 1e-3;
    scene::TipSample sample;
    sample.tip.z_m = on ? 0.0 : 300 * kNm;
    sample.time_ns = static_cast<std::int64_t>(now_s_ * 1e9);
    sample.push.digest = digest_;
    sample.push.state = on ? physics::PushState::Slides : physics::PushState::Free;
    run.force_is(HandForce::Full, now_s_);
    run.add(sample, now_s_);
  }
  // A line whose ink is as wide as `width_m` by (M81).
  void stroke(LessonRun& run, const dvec2& from_m, const dvec2& to_m, double width_m) {
    tick(run, false);
    tick(run, true);
    const double seconds = glm::distance(from_m, to_m) * width_m / physics::inked_area(ink_, physics::Time(1.0)).si;
    const int steps = static_cast<int>(seconds / 1e-3);
    for (int i = 0; i <= steps; ++i) {
      const dvec2 at_m = glm::mix(from_m, to_m, 1.0 * i / steps);
      surface_.touch({Length(at_m.x), Length(at_m.y)}, physics::Time(1e-3));
    }
    surface_.lift();
    publish();
    tick(run, true);
    for (int i = 0; i < 700; ++i) tick(run, false);
    run.look_at_marks(tiles_, now_s_);
  }

  std::shared_ptr<const scene::ParticleSet> set_ =
      std::make_shared<const scene::ParticleSet>(test::particle_set("write-ink"));
  physics::Ink ink_;
  physics::InkedSurface surface_;
  std::vector<scene::MarkTile> tiles_ = std::vector<scene::MarkTile>(scene::kMarkTiles);
  std::uint64_t digest_ = scene::kSoftDigest;
  Lesson lesson_;
  std::vector<curves::SampleModel> samples_;
  std::vector<TrialRow> rows_;
  double now_s_ = 0;
};

TEST_F(WriteInkStep, IsDoneOnceTheLineIsWrittenAsWideAsItShouldBe) {
  auto run = this->run();
  const auto& [from_m, to_m] = std::pair(kLine.lines_m[0][0], kLine.lines_m[0][1]);
  stroke(run, from_m, {0.0, 0.0}, 80 * kNm);
  EXPECT_FALSE(run.end());
  EXPECT_THAT(run.prompt(now_s_).words, HasSubstr("% of the lines are written"));
  stroke(run, {0.0, 0.0}, to_m, 80 * kNm);
  ASSERT_EQ(run.end(), LessonEnd::Finished) << run.prompt(now_s_).words;
  ASSERT_EQ(rows_.size(), 1U);
  EXPECT_LT(std::stod(rows_[0].response), 6 * kNm) << "a square";
  EXPECT_EQ(rows_[0].push.value().strokes, 2U);
}

TEST_F(WriteInkStep, SaysThatALineIsTooNarrowOrTooWideOrBesideTheLines) {
  for (const auto& [width_m, says] :
       {std::pair{50 * kNm, "Go over it again, and move more slowly the next time."},
        {130 * kNm, "Backspace takes a stroke back, R all of them; move faster the next time."}}) {
    surface_ = bare();
    publish();
    auto run = this->run();
    stroke(run, kLine.lines_m[0][0], kLine.lines_m[0][1], width_m);
    const std::string words = run.prompt(now_s_).words, before = "the line is ";
    EXPECT_THAT(words, HasSubstr(says));
    EXPECT_NEAR(std::stod(words.substr(words.find(before) + before.size())), width_m / kNm, 7.0) << words;
  }
  surface_ = bare();
  publish();
  auto run = this->run();
  stroke(run, {-100 * kNm, 250 * kNm}, {100 * kNm, 250 * kNm}, 80 * kNm);
  EXPECT_THAT(run.prompt(now_s_).words, StartsWith("Not done: there are marks more than 160 nm from the lines."));
}

TEST_F(WriteInkStep, IsManagedByASimulatedStudentWithDelayAndTremorAlikeForASeed) {
  lesson_.steps[0].lines = std::make_shared<const LinesToWrite>(
      LinesToWrite{.lines_m = {{dvec2(-300 * kNm, 300 * kNm), dvec2(300 * kNm, 300 * kNm)},
                               {dvec2(0.0, 300 * kNm), dvec2(0.0, -300 * kNm)}},
                   .width_m = 70 * kNm});
  std::vector<std::string> lines;
  for (int i = 0; i < 2; ++i) {
    rows_.clear();
    auto run = this->run();
    SimulatedStudent student({.seed = 5, .abilities = {}}, lesson_, samples_);
    const auto taken = student.take(run);
    ASSERT_TRUE(taken) << taken.error().message;
    ASSERT_EQ(rows_.size(), 1U) << "the writing was felt";
    EXPECT_LT(std::stod(rows_[0].response), 20 * kNm);
    EXPECT_GT(std::stod(rows_[0].response), 0.0);
    EXPECT_GE(rows_[0].push.value().strokes, 2U);
    lines.push_back(line_of(rows_[0]));
  }
  EXPECT_EQ(lines[0], lines[1]);
}

}  // namespace write_ink_step_test
}  // namespace afm::exhibit
