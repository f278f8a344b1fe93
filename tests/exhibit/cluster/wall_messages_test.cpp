// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "exhibit/cluster/frame_inputs.h"
#include "exhibit/cluster/wall_history.h"

namespace wall_messages_test {

using namespace afm;
using namespace afm::cluster;
using namespace afm::exhibit;

FrameMessage some_frame() {
  Moment moment;
  moment.wall.material = 1;
  moment.wall.hovered = 2;
  moment.wall.journey_orders = 4.5;
  moment.wall.fade = 0.25;
  moment.wall.centerpiece = Centerpiece::Journey;
  moment.wall.cue = JumpCue{.kind = physics::EventKind::JumpOffContact, .force_n = -1.4e-9F, .age_s = 0.125};
  input::WandState& wand = moment.wall.wand.emplace();
  wand.position_m = {0.1, 1.2, 2.0};
  wand.orientation_valid = wand.connected = true;
  wand.buttons = 5;
  moment.retracting = true;
  moment.guidance = "Move up until the tip lets go: \u2191";
  moment.letters = "ФИС";
  moment.servo = {{"hand", "0.6 mm/nm", "scale fit"}, {"servo", "1000 Hz", ""}};
  scene::TipState tip;
  tip.material = 1;
  tip.tip.z_m = -1.5e-9;
  tip.active.release_z_m = 9e-9;
  FrameMessage message;
  message.header.number = 7;
  set_moment(moment, tip, "caption", false, message);
  return message;
}

TEST(FrameMessageTest, ComesBackAsTheMomentThatWasSent) {
  const FrameMessage sent = some_frame();
  const auto came = decode<FrameMessage>(encode(sent));
  ASSERT_TRUE(came);
  const Moment moment = moment_of(*came);
  EXPECT_EQ(moment.wall.material, 1U);
  EXPECT_EQ(moment.wall.hovered, 2U);
  EXPECT_EQ(moment.wall.centerpiece, Centerpiece::Journey);
  EXPECT_EQ(moment.wall.journey_orders, 4.5);
  EXPECT_EQ(moment.wall.fade, 0.25);
  ASSERT_TRUE(moment.wall.cue);
  EXPECT_EQ(moment.wall.cue->kind, physics::EventKind::JumpOffContact);
  EXPECT_EQ(moment.wall.cue->force_n, -1.4e-9F);
  EXPECT_EQ(moment.wall.cue->age_s, 0.125);
  ASSERT_TRUE(moment.wall.wand);
  EXPECT_EQ(moment.wall.wand->position_m, glm::dvec3(0.1, 1.2, 2.0));
  EXPECT_TRUE(moment.wall.wand->orientation_valid);
  EXPECT_FALSE(moment.wall.wand->position_valid);
  EXPECT_EQ(moment.wall.wand->buttons, 5U);
  EXPECT_TRUE(moment.retracting);
  EXPECT_EQ(moment.guidance, "Move up until the tip lets go: \u2191");
  EXPECT_EQ(moment.letters, "ФИС");
  ASSERT_EQ(moment.servo.size(), 2U);
  EXPECT_EQ(moment.servo[1].value, "1000 Hz");
  EXPECT_EQ(moment.servo[1].source, "");
  EXPECT_EQ(moment.wall.tip.z_m, -1.5e-9);
  EXPECT_EQ(moment.wall.release_z_m, 9e-9);
  EXPECT_EQ(caption_of(*came), "caption");
}

TEST(FrameMessageTest, IsRefusedWithAnyNumberThatIsNotValid) {
  const auto refused = [](auto&& spoil) {
    FrameMessage message = some_frame();
    spoil(message);
    return !decode<FrameMessage>(encode(message));
  };
  EXPECT_FALSE(refused([](FrameMessage&) {}));
  EXPECT_TRUE(refused([](FrameMessage& m) { m.header.version += 1; }));
  EXPECT_TRUE(refused([](FrameMessage& m) { m.moment.navigation[5] = std::nan(""); }));
  EXPECT_TRUE(refused([](FrameMessage& m) { m.tip.tip.force_n = std::numeric_limits<double>::infinity(); }));
  EXPECT_TRUE(refused([](FrameMessage& m) { m.tip.phase = static_cast<physics::Phase>(99); }));
  EXPECT_TRUE(refused([](FrameMessage& m) { m.tip.material = static_cast<std::int32_t>(scene::kMaxMaterials); }));
  EXPECT_TRUE(refused([](FrameMessage& m) { m.tip.slow_motion = 0; }));
  EXPECT_TRUE(refused([](FrameMessage& m) { m.moment.hovered = -2; }));
  EXPECT_TRUE(refused([](FrameMessage& m) { m.moment.centerpiece = 4; }));
  EXPECT_TRUE(refused([](FrameMessage& m) { m.moment.flags = 1U << 31U; }));
  EXPECT_TRUE(refused([](FrameMessage& m) { m.moment.fade = 1.5; }));
  EXPECT_TRUE(refused([](FrameMessage& m) { m.view.mode = 1000; }));
  EXPECT_TRUE(refused([](FrameMessage& m) { m.view.ipd_m = 1.0; }));
  EXPECT_TRUE(refused([](FrameMessage& m) { m.view.head.orientation = {0, 0, 0, 0}; }));
  EXPECT_TRUE(refused([](FrameMessage& m) { m.panels.right = ShownPanels::kMostRight; }));
  EXPECT_TRUE(refused([](FrameMessage& m) { m.texts.bytes.back() = 'x'; }));
}

std::vector<std::byte> saved(const WallHistory& history) {
  return save_history(history.journal, history.cycles, history.friction, history.edits, history.scan, history.pages,
                      history.push, history.score, history.plan, history.tiles, history.known, history.picture);
}

TEST(WallHistoryTest, IsTheSameForANodeThatComesLate) {
  WallHistory here(3);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-1e-9, 1e-9);
  const auto sample_at = [&](int i) {
    scene::TipSample sample;
    sample.tick = static_cast<std::uint64_t>(i);
    sample.material = i / 400 % 3;
    sample.servo_state = scene::ServoState::Running;
    sample.phase = i % 200 < 100 ? physics::Phase::Attached : physics::Phase::Free;
    sample.hand_height_m = 0.02 * std::sin(0.05 * i);
    sample.tip.z_m = 1e-8 * std::sin(0.05 * i) + noise(random);
    sample.tip.force_n = noise(random);
    sample.surface.xy_m = {1e-9 * i, 0.0};
    return sample;
  };
  here.apply(JournalRecord(EditRecord{.material = 1, .revision = 4}));
  for (int i = 0; i < 900; ++i) here.apply(JournalRecord(sample_at(i)));
  const auto document = saved(here);
  auto there = load_history(document, 3);
  ASSERT_TRUE(there);
  EXPECT_EQ(there->journal, 901U);
  EXPECT_EQ(saved(*there), document);
  for (int i = 900; i < 1500; ++i) {
    const JournalRecord record(sample_at(i));
    here.apply(record);
    there->apply(record);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_FALSE(here.cycles.curves()[i].empty());
    EXPECT_EQ(here.cycles.curves()[i].points(), there->cycles.curves()[i].points());
  }
  EXPECT_EQ(here.friction.contact().size(), there->friction.contact().size());
  EXPECT_EQ(there->edits, here.edits);
  EXPECT_EQ(saved(here), saved(*there));
}

TEST(WallHistoryTest, HasTheNewestPoseOfEveryParticleAndThePush) {
  WallHistory here(1);
  cluster::PoseRecord moved{.particle = 37, .pose = {.x_m = 1e-8, .y_m = -2e-8, .orientation = {0.5, 0.5, 0.5, -0.5}}};
  here.apply(JournalRecord(moved));
  moved.pose.x_m = 3e-8;
  here.apply(JournalRecord(moved));
  here.apply(JournalRecord(scene::TipPush{.normal_n = 1e-9, .hand_n_per_n = 4e9, .particle = 37, .met = 1}));
  ASSERT_EQ(here.pages.size(), 3U);
  EXPECT_EQ(here.pages[2].poses[5], moved.pose);
  EXPECT_EQ(here.pages[2].poses[4], scene::ParticlePose{});
  const auto there = load_history(saved(here), 1);
  ASSERT_TRUE(there);
  EXPECT_EQ(there->pages, here.pages);
  EXPECT_EQ(there->push.particle, 37);
  EXPECT_EQ(there->push.hand_n_per_n, 4e9);
  const auto refused = [&](auto&& spoil) {
    cluster::PoseRecord record = moved;
    spoil(record);
    return !JournalRecord(record).valid();
  };
  EXPECT_FALSE(refused([](cluster::PoseRecord&) {}));
  EXPECT_TRUE(refused([](cluster::PoseRecord& r) { r.particle = scene::kMaxParticles; }));
  EXPECT_TRUE(refused([](cluster::PoseRecord& r) { r.pose.x_m = std::nan(""); }));
  EXPECT_TRUE(refused([](cluster::PoseRecord& r) { r.pose.orientation = {0, 0, 0, 0}; }));
  EXPECT_TRUE(refused([](cluster::PoseRecord& r) { r.pose.moved = static_cast<physics::PushState>(99); }));
  EXPECT_FALSE(JournalRecord(scene::TipPush{.particle = -2}).valid());
  EXPECT_FALSE(JournalRecord(scene::TipPush{.given_j = std::nan("")}).valid());
}

TEST(WallHistoryTest, HasTheNewestPlan) {
  const scene::PlannedPush plan{.from_m = {-8e-8, 0.0}, .to_m = {1e-7, 2e-8}, .particle = 3, .guided = 1};
  WallHistory here(1);
  here.apply(JournalRecord(plan));
  EXPECT_EQ(load_history(saved(here), 1).value().plan, plan);
  here.apply(JournalRecord(scene::PlannedPush{}));
  EXPECT_EQ(load_history(saved(here), 1).value().plan, scene::PlannedPush{});
  const auto refused = [&](auto&& spoil) {
    WallHistory spoilt(1);
    spoilt.plan = plan;
    spoil(spoilt.plan);
    return !JournalRecord(spoilt.plan).valid() && !load_history(saved(spoilt), 1);
  };
  EXPECT_FALSE(refused([](scene::PlannedPush&) {}));
  EXPECT_TRUE(refused([](scene::PlannedPush& p) { p.to_m[1] = std::nan(""); }));
  EXPECT_TRUE(refused([](scene::PlannedPush& p) { p.from_m[0] = 0.1; }));
  EXPECT_TRUE(refused([](scene::PlannedPush& p) { p.to_m = p.from_m; }));
  EXPECT_TRUE(refused([](scene::PlannedPush& p) { p.particle = scene::kMaxParticles; }));
  EXPECT_TRUE(refused([](scene::PlannedPush& p) { p.guided = 2; }));
}

TEST(WallHistoryTest, HasTheNewestMarks) {
  std::vector<scene::MarkTile> marked(scene::kMarkTiles);
  marked[3].pressed_m[2 * scene::kTileSide + 5] = -4e-9;
  marked[3].back_m[2 * scene::kTileSide + 5] = 1e-9;
  marked[200].pressed_m.back() = 2e-9;
  const auto rows = changed_rows({}, marked, 100);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].tile, 3U);
  EXPECT_EQ(rows[0].row, 2U);
  EXPECT_EQ(changed_rows({}, marked, 1).size(), 1U) << "the rest follows in the next frame";
  EXPECT_TRUE(changed_rows(marked, marked, 100).empty());
  WallHistory here(1);
  for (const MarkRecord& row : rows) here.apply(JournalRecord(row));
  EXPECT_EQ(here.tiles, marked);
  EXPECT_EQ(here.marks, 2U);
  const auto there = load_history(saved(here), 1);
  ASSERT_TRUE(there);
  EXPECT_EQ(there->tiles, marked);

  // marks taken back: bare again
  for (const MarkRecord& row : changed_rows(marked, std::vector<scene::MarkTile>(scene::kMarkTiles), 100)) {
    here.apply(JournalRecord(row));
  }
  EXPECT_EQ(here.tiles, std::vector<scene::MarkTile>(scene::kMarkTiles));
  const auto refused = [&](auto&& spoil) {
    MarkRecord row = rows[0];
    spoil(row);
    return !JournalRecord(row).valid();
  };
  EXPECT_FALSE(refused([](MarkRecord&) {}));
  EXPECT_TRUE(refused([](MarkRecord& r) { r.tile = scene::kMarkTiles; }));
  EXPECT_TRUE(refused([](MarkRecord& r) { r.row = scene::kTileSide; }));
  EXPECT_TRUE(refused([](MarkRecord& r) { r.pressed_m[7] = std::nan(""); }));
  EXPECT_TRUE(refused([](MarkRecord& r) { r.back_m[0] = 2e-6; }));
}

TEST(WallHistoryTest, HasTheNewestScore) {
  const scene::TaskScore done{.time_s = 83.5,
                              .rms_m = 18e-9,
                              .work_j = 42e-18,
                              .largest_lateral_n = 3e-9,
                              .strokes = 7,
                              .losses = 2,
                              .undos = 1,
                              .guided = 4,
                              .state = scene::TaskState::Done,
                              .truth = 1};
  WallHistory here(1);
  here.apply(JournalRecord(scene::TaskScore{.time_s = 1.0, .state = scene::TaskState::Running}));
  here.apply(JournalRecord(done));
  EXPECT_EQ(here.score, done);
  const auto there = load_history(saved(here), 1);
  ASSERT_TRUE(there);
  EXPECT_EQ(there->score, done);
  const auto refused = [&](auto&& spoil) {
    scene::TaskScore score = done;
    spoil(score);
    WallHistory spoilt(1);
    spoilt.score = score;
    return !JournalRecord(score).valid() && !load_history(saved(spoilt), 1);
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(refused([](scene::TaskScore&) {}));
  EXPECT_TRUE(refused([](scene::TaskScore& s) { s.state = static_cast<scene::TaskState>(3); }));
  EXPECT_TRUE(refused([](scene::TaskScore& s) { s.time_s = std::nan(""); }));
  EXPECT_TRUE(refused([](scene::TaskScore& s) { s.rms_m = kInfinity; }));
  EXPECT_TRUE(refused([](scene::TaskScore& s) { s.work_j = -kInfinity; }));
  EXPECT_TRUE(refused([](scene::TaskScore& s) { s.largest_lateral_n = std::nan(""); }));
}

// Settings that include the drive of a tapping lever.
TEST(WallHistoryTest, HasEverySettingOfAScan) {
  const ScanChange begun{.frame = 0, .pixel = 0, .choice = {.setpoint_n = 0.8, .free_amplitude_m = 20e-9}};
  const ScanChange changed{.frame = 1,
                           .pixel = 77,
                           .choice = {.setpoint_n = 0.6,
                                      .gain_per_s = 500,
                                      .line_rate_hz = 2,
                                      .tip_radius_m = 5e-9,
                                      .noise_m = 50e-12,
                                      .drift_m_per_s = 1e-9,
                                      .apex_distance_m = 4e-8,
                                      .free_amplitude_m = 15e-9,
                                      .drive_hz = 299850}};
  WallHistory here(2);
  here.apply({JournalKind::ScanBegin, record_of(begun, 1, {})});
  here.apply({JournalKind::ScanChange, record_of(changed, 1, {})});
  const auto there = load_history(saved(here), 2);
  ASSERT_TRUE(there);
  ASSERT_EQ(there->scan.size(), 2U);
  EXPECT_EQ(change_of(there->scan[0]), begun);
  EXPECT_EQ(change_of(there->scan[1]), changed);
  // a drive that no lever has
  for (const double hz : {-1.0, std::nan("")}) {
    ScanChange spoilt = changed;
    spoilt.choice.drive_hz = hz;
    const JournalRecord record(JournalKind::ScanChange, record_of(spoilt, 1, {}));
    EXPECT_FALSE(record.valid() && is_applicable(record)) << hz;
  }
}

TEST(WallHistoryTest, OfAnotherWallOrCutAnywhereIsRefused) {
  WallHistory history(2);
  scene::TipSample sample;
  sample.material = 0;
  sample.servo_state = scene::ServoState::Running;
  sample.phase = physics::Phase::Attached;
  history.apply(JournalRecord(sample));
  const auto document = saved(history);
  EXPECT_TRUE(load_history(document, 2));
  EXPECT_FALSE(load_history(document, 3));
  for (std::size_t length = 0; length < document.size(); ++length) {
    EXPECT_FALSE(load_history(std::span(document).first(length), 2)) << length;
  }
}

TEST(WallHistoryTest, IgnoresMaterialsThatTheWallLacks) {
  WallHistory history(1);
  scene::TipSample sample;
  sample.material = 1;
  history.apply(JournalRecord(sample));
  scene::TipEvent event;
  event.material = 5;
  history.apply(JournalRecord(event));
  history.apply(JournalRecord(EditRecord{.material = 1}));
  EXPECT_EQ(history.journal, 3U);
  EXPECT_TRUE(history.edits.empty());
  EXPECT_TRUE(history.cycles.curves()[0].empty());
}

}  // namespace wall_messages_test
