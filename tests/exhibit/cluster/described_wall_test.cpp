// SPDX-License-Identifier: Apache-2.0
// Every described field of the wall's state is set to something else, one at a time: message and session give it back,
// and the digest notices it. A field that is left out on purpose is listed with its reason.
// Invariant: every field of the wall's state is sent, recorded and in the digest, or is listed with the reason
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cluster/frame_message.h"
#include "core/enumerators.h"
#include "described_parts.h"
#include "exhibit/cluster/frame_digest.h"
#include "exhibit/cluster/frame_inputs.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "exhibit/frame/recorded_wall.h"
#include "exhibit/scan/live_scan.h"
#include "exhibit/scan/scan_subject.h"
#include "support/particles/particle_sets.h"
#include "support/places.h"

namespace afm::exhibit {
namespace described_wall_test {

// ---- fields that are omitted on purpose ----

struct LeftOut {
  std::string_view part;
  std::string_view why;
};

constexpr std::array<LeftOut, 5> kOfTheDevice{{{"wall.wand.time_ns", "moves nothing that is drawn"},
                                               {"wall.wand.motion", "a navigation follows from it"},
                                               {"wall.wand.stops", "acts on the servo"},
                                               {"wall.wand.push", "a navigation follows from it"},
                                               {"wall.wand.turn", "a navigation follows from it"}}};

constexpr std::array<LeftOut, 7> kNotSent{{{"wall.strobe_turns", "follows from the time of the tip's state"},
                                           {"curves", "grow from the journal"},
                                           {"scan", "follows from the journal and ShownMoment::scan_frame"},
                                           {"wall.scan", "set by show_scan()"},
                                           {"wall.scan_line", "set by show_scan()"},
                                           {"wall.particles", "follow from the journal"},
                                           {"results", "shown in films, which one machine draws"}}};

constexpr std::array<LeftOut, 10> kNotRecorded{{{"curves", "follow from the session's samples"},
                                                {"wall.strobe_turns", "follows from the time of the sample"},
                                                {"by_wand", "drawn without a sample, of which a session has one"},
                                                {"stopped", "follows from TipSample::renderer"},
                                                {"letters", "labels of the keyboard at hand"},
                                                {"scan", "recorded as ScanProgress: scan_progress_of()"},
                                                {"wall.scan", "set by show_scan()"},
                                                {"wall.scan_line", "set by show_scan()"},
                                                {"wall.particles", "follow from a replay of the session's ticks"},
                                                {"results", "shown in films, which are made without a live wall"}}};

constexpr std::array<LeftOut, 10> kNotDrawn{
    {{"stopped", "drawn in the state Fault alone"},
     {"wall.swing.phase_rad", "drawn of a lever that taps alone"},
     {"by_wand", "drawn without a sample alone"},
     {"letters", "drawn by the list of keys alone"},
     {"wall.tip.tip_height_m", "the lever is drawn by Z and deflection"},
     {"wall.tip.sample_deformation_m", "the lever is drawn by Z and deflection"},
     {"wall.wand.orientation_valid", "the wand is drawn by its pose alone"},
     {"wall.wand.position_valid", "the wand is drawn by its pose alone"},
     {"wall.wand.connected", "the wand is drawn by its pose alone"},
     {"wall.wand.buttons", "the wand is drawn by its pose alone"}}};

template <std::size_t first, std::size_t second>
std::vector<LeftOut> joined(const std::array<LeftOut, first>& a, const std::array<LeftOut, second>& b) {
  std::vector<LeftOut> all(a.begin(), a.end());
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

// Judges each part of `record`: it is kept, or it is on the list.
template <class Record, class IsKept>
void expect_kept(const Record& record, std::vector<LeftOut> left_out, const IsKept& is_kept) {
  for (const auto& [part, text] : parts_of(record)) {
    const auto listed =
        std::find_if(left_out.begin(), left_out.end(), [&](const LeftOut& row) { return row.part == part; });
    const bool kept = is_kept(part);
    if (listed == left_out.end()) {
      EXPECT_TRUE(kept) << part << " is lost";
    } else {
      EXPECT_FALSE(kept) << part << " is kept, although it is listed: " << listed->why;
      left_out.erase(listed);
    }
  }
  for (const LeftOut& row : left_out) ADD_FAILURE() << row.part << " is listed, but there is no such field";
}

// True if one part of a record returns unchanged, before and after a change.
template <class Record, class Through>
bool comes_back(const Record& record, const std::string& part, const Through& through) {
  const Record other = changed(record, part);
  return parts_of(record)[part] != parts_of(other)[part] && parts_of(through(record))[part] == parts_of(record)[part] &&
         parts_of(through(other))[part] == parts_of(other)[part];
}

class DescribedWall : public ::testing::Test {
 protected:
  static constexpr std::int64_t kNowNs = 5'000'000'000;

  void SetUp() override {
    ExhibitFiles files;
    files.assets_dir = support::source("assets");
    auto stage = load_exhibit(files);
    ASSERT_TRUE(stage) << stage.error().message;
    stage_.emplace(std::move(*stage));
    for (const scene::MaterialEntry& entry : stage_->materials.materials) {
      felt_.push_back(curves::make_sample_model(curves::ContactSetup{entry, {}, {}}).value());
      curves_.push_back(CycleCurve::from({{20.0, 0.0}, {2.0, -0.5}, {-1.0, 0.5}, {10.0, -1.0}}));
    }
    scan_.emplace(scan_subject(stage_->wall_scene, 0, felt_.front()));
    particles_.set = &set_;
  }

  // Moment in which every field differs from a new moment.
  Moment moment(Centerpiece centerpiece) const {
    Moment moment;
    WallState& wall = moment.wall;
    wall.material = 0;
    wall.tip = {
        .z_m = 3e-9, .force_n = -0.4e-9, .height_m = 2e-9, .deflection_m = -4e-9, .sample_deformation_m = 1e-10};
    wall.surface = {.xy_m = {1e-9, -2e-9}, .height_m = 3e-9};
    wall.release_z_m = 12e-9;
    wall.hovered = 1;
    wall.wand = {.time_ns = 1, .position_m = {0.5, 1.25, 1.75}, .room_from_wand = {0.5, 0.5, 0.5, 0.5}};
    wall.wand->orientation_valid = wall.wand->position_valid = wall.wand->connected = true;
    wall.wand->buttons = 5;
    wall.centerpiece = centerpiece;
    wall.journey_orders = 3.0;
    wall.fade = 0.25;
    wall.navigation = glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(0.1, 0, 0.2)), 0.4, glm::dvec3(0, 1, 0));
    wall.cue = {.kind = physics::EventKind::JumpToContact, .force_n = -0.4e-9F, .age_s = 0.125};
    wall.scan = true;
    wall.scan_line = {glm::dvec3(-1e-8, 0.0, 1e-9), glm::dvec3(1e-8, 0.0, 1e-9)};
    wall.particles = &particles_;
    wall.stroboscope = true;
    wall.strobe_turns = 0.25;
    wall.swing = {.amplitude_m = 18e-9, .phase_rad = 1.2};
    moment.servo_state = scene::ServoState::Running;
    moment.phase = physics::Phase::Free;
    moment.realtime = true;
    moment.slow_motion = 2.0;
    moment.guidance = "Lift the tip";
    moment.servo = {{"hand", "0.6 mm/nm", "scale fit"}, {"servo", "1000 Hz", "period"}};
    moment.curves = curves_;
    moment.scan = &*scan_;
    return moment;
  }

  // Tip state as in the servo's answer.
  static scene::TipState tip_of(const Moment& moment) {
    scene::TipState tip;
    tip.tip = moment.wall.tip;
    tip.swing = moment.wall.swing;
    tip.surface = moment.wall.surface;
    tip.active.release_z_m = moment.wall.release_z_m;
    tip.active.slow_motion = moment.slow_motion;
    tip.material = static_cast<std::int32_t>(*moment.wall.material);
    tip.phase = moment.phase;
    tip.servo_state = moment.servo_state;
    tip.realtime = moment.realtime ? 1 : 0;
    return tip;
  }

  static Moment through_message(const Moment& moment) {
    cluster::FrameMessage message;
    set_moment(moment, tip_of(moment), "", false, message);
    const auto came = cluster::decode<cluster::FrameMessage>(cluster::encode(message));
    return came ? moment_of(*came) : Moment();
  }

  Moment through_session(const Moment& moment) const {
    const std::vector<std::string> names = stage_->materials.names();
    servo::RecordedSession session;
    session.material = names.at(*moment.wall.material);
    session.shown = names;
    session.realtime = moment.realtime;
    session.slow_motion = moment.slow_motion;
    scene::TipSample& sample = session.samples.emplace_back();
    sample.time_ns = kNowNs;
    sample.tip = moment.wall.tip;
    sample.surface = moment.wall.surface;
    sample.swing = moment.wall.swing;
    sample.servo_state = moment.servo_state;
    sample.phase = moment.phase;
    if (const auto& cue = moment.wall.cue) {
      const auto force_n = static_cast<double>(cue->force_n);
      session.events.push_back({.kind = cue->kind,
                                .time_ns = kNowNs - static_cast<std::int64_t>(cue->age_s * 1e9),
                                .force_before_n = force_n,
                                .force_after_n = force_n});
    }
    const std::array frames{wall_frame_of(moment, kNowNs, names)};
    nlohmann::json written, read;
    session.wall = servo::frames_of(servo::json_of(frames, written), read);
    return moment_on_wall(session, names, kNowNs).moment;
  }

  std::uint64_t digest(const Moment& moment) const {
    return digest_of(FrameBuilder(stage_->wall_scene, felt_, stage_->eyes).build(moment), {});
  }

  std::optional<Stage> stage_;
  std::vector<curves::SampleModel> felt_;
  std::vector<CycleCurve> curves_;
  std::optional<LiveScan> scan_;
  scene::ParticleSet set_ = test::particle_set("gold-row");
  ParticlesNow particles_;
};

TEST_F(DescribedWall, ComesBackFromAMessage) {
  const Moment shown = moment(Centerpiece::Analogy);
  expect_kept(shown, joined(kOfTheDevice, kNotSent),
              [&](const std::string& part) { return comes_back(shown, part, through_message); });
}

TEST_F(DescribedWall, ComesBackFromASession) {
  const Moment shown = moment(Centerpiece::Analogy);
  expect_kept(shown, joined(kOfTheDevice, kNotRecorded), [&](const std::string& part) {
    return comes_back(shown, part, [&](const Moment& moment) { return through_session(moment); });
  });
}

// Each part of a moment changes at least one of the wall's pictures.
TEST_F(DescribedWall, ChangesTheDigestOfTheFrame) {
  std::vector<Moment> walls{moment(Centerpiece::Instrument)};  // wall with an image in the place of the curve
  for (const Centerpiece centerpiece : core::kEnumerators<Centerpiece>) {
    walls.push_back(moment(centerpiece));
    walls.back().scan = nullptr;
    walls.back().wall.scan = false;
  }
  std::vector<std::uint64_t> digests;
  for (const Moment& wall : walls) digests.push_back(digest(wall));
  expect_kept(walls.front(), joined(kOfTheDevice, kNotDrawn), [&](const std::string& part) {
    for (std::size_t i = 0; i < walls.size(); ++i) {
      if (digest(changed(walls[i], part)) != digests[i]) return true;
    }
    return false;
  });
}

// ---- for whom and how it is drawn ----

cluster::ShownView some_view() {
  return {.head = {.position_m = {0.1, 1.6, 2.0}},
          .depth_range_m = {1.0, 3.0},
          .nearest = {0.01, 0.02},
          .farthest = {0.03, 0.04},
          .flags = cluster::ShownView::kDepth,
          .relief = 0};
}

TEST(DescribedView, GivesHeadAndDepthBack) {
  constexpr std::array<LeftOut, 3> kOfThePicture{
      {{"ipd_m", "kept by ViewPicture"}, {"drawn_ipd_m", "kept by ViewPicture"}, {"mode", "kept by ViewPicture"}}};
  constexpr std::array<LeftOut, 2> kElsewhere{
      {{"flags", "kept by ViewPicture, but for the two of depth"}, {"padding", "carries nothing"}}};
  const auto through = [](const cluster::ShownView& view) {
    cluster::ShownView came;
    came.head = pose_of(head_of(view.head));
    set_depth(depth_of(view), came);
    return came;
  };
  expect_kept(some_view(), joined(kOfThePicture, kElsewhere),
              [&](const std::string& part) { return comes_back(some_view(), part, through); });
  cluster::ShownView hard = some_view();
  hard.flags = cluster::ShownView::kHardDepth;
  EXPECT_EQ(through(hard).flags, hard.flags);
  EXPECT_EQ(through(some_view()).flags, some_view().flags);
}

TEST(DescribedView, ChangesTheDigestOfTheFrame) {
  expect_kept(some_view(), {}, [&](const std::string& part) {
    return digest_of({}, changed(some_view(), part)) != digest_of({}, some_view());
  });
}

// ---- panels ----

TEST(DescribedPanels, ChangeTheDigestWhereverTheyAre) {
  render::FrameState frame;
  std::size_t slots = 0;
  core::for_each_member(
      [&](auto& slot) {
        const std::uint64_t before = digest_of(frame, {});
        slot.placement.right_m.x += 1.0;
        EXPECT_NE(digest_of(frame, {}), before) << "slot " << slots;
        ++slots;
      },
      frame.panels);
  EXPECT_EQ(slots, core::kMembers<render::FramePanels>);
}

}  // namespace described_wall_test
}  // namespace afm::exhibit
