// SPDX-License-Identifier: Apache-2.0
// Invariant: an image taken by hand depends only on the servo's samples; places not visited stay empty
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "curves/sample_model.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/recorded_wall.h"
#include "exhibit/scan/live_scan.h"
#include "exhibit/scan/scan_hand.h"
#include "exhibit/scan/scan_panels.h"
#include "haptics/device.h"
#include "support/places.h"

// An image that a hand takes, and a scan that leads one.
namespace afm::exhibit {
namespace hand_scan_test {

using scene::ScanHand;
using scene::TipSample;

constexpr double kSideM = 64e-9;
constexpr double kMPerS = 40e-9;  // speed of the tip

const Phrases& english() {
  static const Phrases phrases = Phrases::load(support::source("assets/guidance/en.toml")).value();
  return phrases;
}

// Round hills, 2 nm high.
double hills_m(double x_m, double y_m) {
  constexpr double kWaveM = 2e8;  // wave number in radians per metre
  return 1e-9 * (std::sin(kWaveM * x_m) + std::cos(1.3 * kWaveM * y_m));
}

ScanSubject hills() {
  ScanSubject subject;
  subject.traced = [](double) { return hills_m; };
  subject.drawn_m = hills_m;
  subject.side_m = 200e-9;
  subject.tip_radius_m = 10e-9;
  subject.adhesion_n = 1e-9;
  return subject;
}

// The servo's ticks of a hand that goes along +x at `y_m`.
class Ticks {
 public:
  explicit Ticks(bool feedback) : feedback_(feedback) {}

  void line(double y_m, std::vector<TipSample>& samples) {
    for (double x_m = -0.5 * kSideM; x_m < 0.5 * kSideM; x_m += 1e-3 * kMPerS) {
      TipSample& sample = samples.emplace_back();
      sample.tick = ++tick_;
      sample.time_ns = static_cast<std::int64_t>(tick_) * 1'000'000;
      sample.phase = physics::Phase::Attached;
      sample.surface = {.xy_m = {x_m, y_m}, .height_m = hills_m(x_m, y_m)};
      sample.tip.z_m = 1e-9 - sample.surface.height_m;  // constant height of the hand
      sample.tip.deflection_m = 0.1 * sample.tip.z_m;
      sample.lateral_force_n = {2e-9, -1e-9};
      sample.scan = {.time_ns = sample.time_ns, .hand = ScanHand::Scans, .feedback = feedback_ ? 1U : 0U};
    }
  }

 private:
  bool feedback_;
  std::uint64_t tick_ = 100;
};

HandPart part(bool feedback) { return {.paints = true, .feedback = feedback, .side_m = kSideM, .first_tick = 100}; }

// A measured sample is felt at another scale: the servo's places have that scale, the image has the sample's.
TEST(HandScan, PaintsAMeasuredSampleInItsOwnMetres) {
  constexpr scene::TopographyScale kShown{.lateral = 0.5, .vertical = 4.0};
  for (const bool feedback : {true, false}) {
    LiveScan measured_as_shown(hills(), part(feedback));
    ScanSubject subject = hills();
    subject.shown = kShown;
    LiveScan scan(subject, part(feedback));
    Ticks ticks(feedback);
    std::vector<TipSample> samples;
    ticks.line(10e-9, samples);
    for (TipSample sample : samples) {
      measured_as_shown.follow_hand(sample);
      for (double& place_m : sample.surface.xy_m) place_m *= kShown.lateral;
      sample.surface.height_m *= kShown.vertical;
      scan.follow_hand(sample);
    }
    for (std::size_t i = 0; i < scan.maps().height_m[0].size(); ++i) {
      const double expected = measured_as_shown.maps().height_m[0][i], painted = scan.maps().height_m[0][i];
      ASSERT_TRUE(std::isnan(expected) ? std::isnan(painted) : std::abs(painted - expected) < 1e-18) << i;
    }
  }
}

double at(const std::vector<double>& map, double x_m, double y_m) {
  const auto column = static_cast<std::size_t>((x_m / kSideM + 0.5) * LiveScan::kPixels);
  const auto row = static_cast<std::size_t>((0.5 - y_m / kSideM) * LiveScan::kPixels);
  return map[row * LiveScan::kPixels + column];
}

TEST(HandScan, PaintsWhatTheHandPassesAndLeavesTheRestEmpty) {
  for (const bool feedback : {true, false}) {
    LiveScan scan(hills(), part(feedback));
    EXPECT_EQ(scan.subject().side_m, kSideM);
    Ticks ticks(feedback);
    std::vector<TipSample> samples;
    ticks.line(10e-9, samples);
    for (const TipSample& sample : samples) scan.follow_hand(sample);
    scan.advance(1.0);  // no effect, since the hand is the scanner
    EXPECT_NEAR(scan.seen_share(), 2.0 / LiveScan::kPixels, 1e-3);
    const ScanMaps& maps = scan.maps();
    for (const double x_m : {-20e-9, 3e-9, 17e-9}) {
      const double cell_m = 0.5e-9;  // change of the surface within a cell
      if (feedback) {
        EXPECT_NEAR(at(maps.height_m[0], x_m, 10e-9), hills_m(x_m, 10e-9), cell_m);
        EXPECT_NEAR(at(maps.height_m[1], x_m, 10e-9), 0.0, 0.05e-9) << "the loop is fast";
      } else {
        EXPECT_NEAR(at(maps.height_m[0], x_m, 10e-9), 1e-9, 1e-15) << "the hand keeps its height";
        EXPECT_NEAR(at(maps.height_m[1], x_m, 10e-9), 0.1 * (hills_m(x_m, 10e-9) - 1e-9), 0.1 * cell_m);
      }
      EXPECT_EQ(at(maps.lateral_n[0], x_m, 10e-9), 2e-9);
      EXPECT_EQ(at(maps.lateral_n[1], x_m, 10e-9), -1e-9);
      EXPECT_TRUE(std::isnan(at(maps.height_m[0], x_m, -10e-9)));
    }
    const render::ImagePanel panel = image_panel(scan, "Gold", english());
    EXPECT_THAT(panel.subtitle,
                testing::HasSubstr(feedback ? "feedback on, 2 % covered" : "feedback off, 2 % covered"));
    EXPECT_EQ(panel.heights[0].title, feedback ? "Height" : "Deflection");
    const auto empty = std::count_if(panel.heights[0].grid.colors.begin(), panel.heights[0].grid.colors.end(),
                                     [](const auto& color) { return color[3] == 0; });
    EXPECT_EQ(empty, static_cast<std::ptrdiff_t>(LiveScan::kPixels * (LiveScan::kPixels - LiveScan::kCell)));
  }
}

TEST(HandScan, PaintsOnlyWhereTheTipIsOnTheSampleAndInTheSquare) {
  LiveScan scan(hills(), part(true));
  Ticks ticks(true);
  std::vector<TipSample> samples;
  ticks.line(0.0, samples);
  for (TipSample sample : samples) {
    sample.phase = physics::Phase::Free;
    scan.follow_hand(sample);
    sample.phase = physics::Phase::Attached;
    sample.surface.xy_m[1] = 0.51 * kSideM;
    scan.follow_hand(sample);
    sample.surface.xy_m[1] = std::nan("");
    scan.follow_hand(sample);
  }
  EXPECT_EQ(scan.seen_share(), 0.0);
}

// The servo feels the sample as before until then.
TEST(HandScan, BeginsWhereTheFeedbackCanChange) {
  for (const auto state : {scene::ServoState::Running, scene::ServoState::Disarmed}) {
    LiveScan scan(hills(), part(true));
    Ticks ticks(true);
    std::vector<TipSample> samples;
    ticks.line(0.0, samples);
    for (TipSample& sample : samples) sample.servo_state = state;
    for (const TipSample& sample : samples) scan.follow_hand(sample);
    EXPECT_EQ(scan.seen_share() > 0.0, state == scene::ServoState::Disarmed);
    samples[0].phase = physics::Phase::Free;
    for (const TipSample& sample : samples) scan.follow_hand(sample);
    EXPECT_GT(scan.seen_share(), 0.0);
  }
}

TEST(HandScan, ShowsASlowLoopAsAResidualDeflection) {
  LiveScan scan(hills(), part(true));
  for (int i = 0; i < 6; ++i) scan.step(ScanRow::Gain, -1);
  Ticks ticks(true);
  std::vector<TipSample> samples;
  ticks.line(0.0, samples);
  for (const TipSample& sample : samples) scan.follow_hand(sample);
  const auto& residual = scan.maps().height_m[1];
  EXPECT_GT(*std::max_element(residual.begin(), residual.end(),
                              [](double a, double b) { return (std::isnan(a) ? 0 : a) < (std::isnan(b) ? 0 : b); }),
            0.2e-9);
}

TEST(HandScan, IsTheSameAgainFromItsSession) {
  LiveScan scan(hills(), part(true));
  Ticks ticks(true);
  std::vector<TipSample> samples;
  std::size_t followed = 0;
  for (const double y_m : {20e-9, 5e-9, -12e-9}) {
    ticks.line(y_m, samples);
    for (; followed < samples.size(); ++followed) scan.follow_hand(samples[followed]);
    scan.step(ScanRow::Gain, -2);
    scan.step(ScanRow::Noise, 1);
    scan.step(ScanRow::Drift, 1);
  }
  Moment moment;
  show_scan(scan, moment);
  const servo::WallFrame frame = wall_frame_of(moment, 0, {});
  ASSERT_TRUE(frame.scan_hand.has_value());
  const ScanProgress progress = scan_progress_of(frame);
  EXPECT_EQ(progress, scan.progress());
  ASSERT_TRUE(LiveScan::valid(progress));
  ticks.line(-30e-9, samples);  // line after that frame
  const LiveScan again(hills(), progress, samples);
  EXPECT_EQ(image_panel(again, "", english()), image_panel(scan, "", english()));
  ScanProgress bad = progress;
  bad.hand->side_m = std::nan("");
  EXPECT_FALSE(LiveScan::valid(bad));
  bad = progress;
  bad.frame = 1;
  EXPECT_FALSE(LiveScan::valid(bad));
}

// ---- the square that the hand reaches, and the scan that leads it ----

constexpr std::array<double, 16> kFlat{1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1};
constexpr HandSize kSize{.sideways = 1e6, .upwards = 1e6};

TEST(LeadingScan, KeepsToWhatTheDeviceReaches) {
  const scene::SharedDevice omni = haptics::shared(haptics::omni_like("hand"));
  const double side_m = reachable_side_m(omni, kFlat, kSize, 200e-9);
  EXPECT_NEAR(side_m * kSize.sideways, 2.0 * (0.035 - 0.006), 1e-9) << "towards the user it is 35 mm";
  EXPECT_EQ(reachable_side_m(omni, kFlat, kSize, 20e-9), 20e-9);
  scene::SharedDevice plane = omni;
  plane.workspace_min_m[2] = plane.workspace_max_m[2] = 0.0;
  EXPECT_NEAR(reachable_side_m(plane, kFlat, kSize, 200e-9) * kSize.sideways, 2.0 * 0.074, 1e-9);
}

TEST(LeadingScan, IsSlowEnoughForAHandAndWaitsForIt) {
  LiveScan scan(hills(), HandPart{.side_m = kSideM});
  LeadingScan leading;
  glm::dvec2 tip_m(0.0);
  glm::dvec3 before_m(0.0);
  double fastest_m_per_s = 0;
  constexpr double kFrameS = 1.0 / 60.0;
  for (int frame = 0; frame < 4000; ++frame) {
    const scene::ScanLead lead = leading.advance(scan, kSize, true, tip_m, false, kFrameS);
    EXPECT_EQ(lead.hand, ScanHand::Led);
    tip_m = {lead.apex_xy_m[0], lead.apex_xy_m[1]};
    const glm::dvec3 now_m = kSize.sideways * glm::dvec3(tip_m, lead.height_m);
    if (frame > 1) fastest_m_per_s = std::max(fastest_m_per_s, glm::distance(now_m, before_m) / kFrameS);
    before_m = now_m;
  }
  EXPECT_GT(scan.row(), 20U);
  EXPECT_LT(scan.row(), 40U);
  EXPECT_LE(fastest_m_per_s, LeadingScan::kReturnMPerS * (1 + 1e-9));
  const std::uint32_t pixel = scan.progress().pixel;
  for (int frame = 0; frame < 60; ++frame) {
    leading.advance(scan, kSize, true, tip_m + glm::dvec2(20e-9, 0.0), false, kFrameS);
  }
  EXPECT_LE(scan.progress().pixel, pixel + 1) << "the hand stayed behind";
  for (int frame = 0; frame < 60; ++frame) leading.advance(scan, kSize, false, tip_m, false, kFrameS);
  EXPECT_LE(scan.progress().pixel, pixel + 1) << "no hand was led";
}

TEST(LeadingScan, FollowsTheHeightsOrStaysLevel) {
  LiveScan scan(hills(), HandPart{.side_m = kSideM});
  LeadingScan leading;
  double highest_m = 0;
  glm::dvec2 tip_m(0.0);
  for (int frame = 0; frame < 600; ++frame) {
    const bool level = frame < 300;
    const scene::ScanLead lead = leading.advance(scan, kSize, true, tip_m, level, 1.0 / 60.0);
    tip_m = {lead.apex_xy_m[0], lead.apex_xy_m[1]};
    if (level && frame > 100) {
      EXPECT_NEAR(lead.height_m, 0.0, 1e-15);
    }
    if (!level) highest_m = std::max(highest_m, std::abs(lead.height_m));
  }
  EXPECT_GT(highest_m, 0.5e-9);
}

TEST(LeadingScan, SaysWhatTheHandCanDo) {
  using testing::HasSubstr, testing::StartsWith;
  const LiveScan led(hills(), HandPart{.side_m = kSideM}), painted(hills(), part(true));
  scene::TipState tip;
  const auto said = [&](const LiveScan& scan) { return hand_guidance(scan, tip, english()).value_or(""); };
  EXPECT_THAT(said(led), HasSubstr("press and hold Turn-On"));
  tip.servo_state = scene::ServoState::Running;
  tip.phase = physics::Phase::Free;
  EXPECT_THAT(said(led), StartsWith("Hold Turn-On"));
  tip.led = 1;
  EXPECT_THAT(said(led), HasSubstr("follow the tip"));
  tip.led = 0;
  tip.lead_lost = 1;
  EXPECT_THAT(said(led), HasSubstr("let go of Turn-On, then hold it again"));
  tip.lead_lost = 0;
  tip.led = 1;
  EXPECT_THAT(said(painted), StartsWith("Lower the tip"));
  tip.phase = physics::Phase::Attached;
  EXPECT_THAT(said(painted), StartsWith("Lift the tip off the sample once"));
  tip.level = 1;
  EXPECT_THAT(said(painted), StartsWith("Your hand takes the image"));
}

// The guidance of the procedure explains what went wrong, and how to get the force back.
TEST(LeadingScan, LeavesTheWayBackToTheForceToTheProcedure) {
  const LiveScan led(hills(), HandPart{.side_m = kSideM}), painted(hills(), part(true));
  scene::TipState tip;
  tip.servo_state = scene::ServoState::Fault;
  tip.fault = scene::FaultCode::LateTick;
  EXPECT_EQ(hand_guidance(led, tip, english()), std::nullopt);
  EXPECT_EQ(hand_guidance(painted, tip, english()), std::nullopt);
  for (const physics::Phase phase : {physics::Phase::Free, physics::Phase::WaitForLift}) {
    for (const scene::ServoState state :
         {scene::ServoState::Fading, scene::ServoState::Disarmed, scene::ServoState::Arming}) {
      tip.phase = phase;
      tip.servo_state = state;
      EXPECT_EQ(hand_guidance(painted, tip, english()), std::nullopt);
    }
  }
  tip.phase = physics::Phase::Attached;  // painting works without a force, too
  EXPECT_THAT(hand_guidance(painted, tip, english()).value_or(""), testing::StartsWith("Your hand takes the image"));
}

}  // namespace hand_scan_test
}  // namespace afm::exhibit
