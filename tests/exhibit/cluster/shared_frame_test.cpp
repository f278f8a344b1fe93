// SPDX-License-Identifier: Apache-2.0
// A machine of a wall builds from a message the same frame as a single machine, to the last bit according to the digest
// of everything that is drawn.
// Invariant: the machines of a wall draw the same bytes from a message
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <optional>
#include <vector>

#include "cluster/frame_message.h"
#include "exhibit/cluster/frame_digest.h"
#include "exhibit/cluster/frame_inputs.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "exhibit/state/cycle_history.h"
#include "support/places.h"

namespace afm::exhibit {
namespace shared_frame_test {

class SharedFrame : public ::testing::Test {
 protected:
  void SetUp() override {
    ExhibitFiles files;
    files.assets_dir = support::source("assets");
    auto stage = load_exhibit(files);
    ASSERT_TRUE(stage) << stage.error().message;
    stage_.emplace(std::move(*stage));
    for (const scene::MaterialEntry& entry : stage_->materials.materials) {
      felt_.push_back(curves::make_sample_model(curves::ContactSetup{entry, {}, {}}).value());
    }
    cycles_.emplace(felt_.size());
  }

  // One of a session's twenty samples: the tip goes down and up, and everything else changes, too.
  scene::TipState tip_at(int i) const {
    scene::TipState tip;
    tip.time_ns = 1'000'000'000LL + 100'000'000LL * i;
    tip.material = i < 2 ? -1 : i % static_cast<int>(felt_.size());
    tip.tip.z_m = 20e-9 * std::cos(0.1 * std::numbers::pi * i);
    tip.tip.force_n = 1e-9 * std::sin(0.3 * i);
    tip.phase = i % 4 == 1 ? physics::Phase::Attached : physics::Phase::Free;
    tip.servo_state = scene::ServoState::Running;
    return tip;
  }
  Moment moment_at(int i, const scene::TipState& tip) const {
    Moment moment = moment_of(tip, i % 4 > 1);
    moment.guidance = i % 2 == 0 ? "Push down" : "Lift the tip";
    moment.wall.navigation =
        glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(0.01 * i, 0, 0.02)), 0.05 * i, glm::dvec3(0, 1, 0));
    if (i % 3 == 0) moment.wall.hovered = 1;
    if (i % 5 == 2) {
      input::WandState& wand = moment.wall.wand.emplace();
      wand.position_m = {0.1 * i, 1.2, 1.5};
      wand.position_valid = wand.orientation_valid = wand.connected = true;
    }
    if (i % 7 == 3)
      moment.wall.cue = JumpCue{
          .kind = physics::EventKind::JumpToContact, .force_n = -1e-10F * static_cast<float>(i), .age_s = 0.01 * i};
    moment.wall.centerpiece = i % 6 == 4   ? Centerpiece::Journey
                              : i % 6 == 5 ? Centerpiece::Analogy
                                           : Centerpiece::Instrument;
    moment.wall.journey_orders = moment.wall.centerpiece == Centerpiece::Journey ? 0.3 * i : 0.0;
    moment.wall.fade = 0.02 * i;
    moment.curves = cycles_->curves();
    moment.servo = {{"hand", "0.6 mm/nm", "scale fit"}, {"servo", std::to_string(990 + i) + " Hz", ""}};
    return moment;
  }

  std::optional<Stage> stage_;
  std::optional<CycleHistory> cycles_;
  std::vector<curves::SampleModel> felt_;
};

TEST_F(SharedFrame, IsTheOneOfASingleMachineAtTwentyMoments) {
  const FrameBuilder frames(stage_->wall_scene, felt_, stage_->eyes);
  std::uint64_t before = 0;
  for (int i = 0; i < 20; ++i) {
    const scene::TipState tip = tip_at(i);
    const Moment moment = moment_at(i, tip);
    cluster::FrameMessage message;
    set_moment(moment, tip, "", false, message);
    const auto came = cluster::decode<cluster::FrameMessage>(cluster::encode(message));
    ASSERT_TRUE(came) << i;
    Moment shared = moment_of(*came);
    shared.curves = moment.curves;
    const std::uint64_t alone = digest_of(frames.build(moment), message.view);
    EXPECT_EQ(digest_of(frames.build(shared), came->view), alone) << i;
    EXPECT_NE(alone, before) << i;
    before = alone;
  }
}

// Includes the parameter panel's report on an edit.
TEST_F(SharedFrame, HasTheTipOfTheHand) {
  scene::TipState tip = tip_at(5);
  tip.surface = {.xy_m = {1e-9, -2e-9}, .height_m = 3e-9};
  tip.active.release_z_m = 14e-9;
  tip.active.slow_motion = 2.0;
  tip.active.edit_revision = 6;
  tip.active.scale_mode = scene::ScaleMode::Particles;
  tip.acknowledged.refused_edit = 5;
  tip.realtime = true;
  cluster::FrameMessage message;
  set_moment(moment_at(5, tip), tip, "", false, message);
  const auto came = cluster::decode<cluster::FrameMessage>(cluster::encode(message));
  ASSERT_TRUE(came);
  const scene::TipState there = tip_of(*came);
  EXPECT_EQ(there.time_ns, tip.time_ns);
  EXPECT_EQ(there.tip.z_m, tip.tip.z_m);
  EXPECT_EQ(there.tip.force_n, tip.tip.force_n);
  EXPECT_EQ(there.surface.xy_m, tip.surface.xy_m);
  EXPECT_EQ(there.surface.height_m, tip.surface.height_m);
  EXPECT_EQ(there.active.release_z_m, tip.active.release_z_m);
  EXPECT_EQ(there.active.slow_motion, tip.active.slow_motion);
  EXPECT_EQ(there.active.edit_revision, tip.active.edit_revision);
  EXPECT_EQ(there.active.scale_mode, tip.active.scale_mode);
  EXPECT_EQ(there.acknowledged.refused_edit, tip.acknowledged.refused_edit);
  EXPECT_EQ(there.material, tip.material);
  EXPECT_EQ(there.phase, tip.phase);
  EXPECT_EQ(there.servo_state, tip.servo_state);
  EXPECT_EQ(there.realtime, tip.realtime);
}

}  // namespace shared_frame_test
}  // namespace afm::exhibit
