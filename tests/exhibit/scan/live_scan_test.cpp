// SPDX-License-Identifier: Apache-2.0
// Invariant: a scan on the wall depends only on its sample and on what a session records
#include "exhibit/scan/live_scan.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "core/enumerators.h"
#include "curves/sample_model.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/recorded_wall.h"
#include "exhibit/scan/scan_cause.h"
#include "exhibit/scan/scan_panels.h"
#include "exhibit/scan/scan_subject.h"
#include "scanned_sample.h"
#include "support/image_files.h"
#include "support/places.h"
#include "support/scratch_folder.h"

// The scan that the live wall shows, driven as the keys drive it.
namespace afm::exhibit {
namespace live_scan_test {

constexpr std::size_t kMica = 0, kGold = 1;
constexpr double kFrameS = 1.0 / 60.0;

void scan_for(LiveScan& scan, double seconds) {
  for (double t = 0; t < seconds; t += kFrameS) scan.advance(kFrameS);
}

// Whole lines, however long one takes.
void scan_lines(LiveScan& scan, double lines) { scan_for(scan, lines / scan.choice().line_rate_hz); }

// NaN equals NaN.
bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

bool same_images(const LiveScan& a, const LiveScan& b) {
  for (std::size_t pass = 0; pass < 2; ++pass) {
    if (!same(a.maps().height_m[pass], b.maps().height_m[pass]) ||
        !same(a.maps().error_n[pass], b.maps().error_n[pass]) ||
        !same(a.maps().lateral_n[pass], b.maps().lateral_n[pass])) {
      return false;
    }
  }
  return true;
}

std::size_t measured_points(const LiveScan& scan) {
  const auto& map = scan.maps().height_m[0];
  return static_cast<std::size_t>(std::count_if(map.begin(), map.end(), [](double h) { return std::isfinite(h); }));
}

// ---- every artefact can be produced and undone from the keyboard ----

struct Pressed {
  ScanRow row;
  int times;  // number of presses of +, or of - if negative
};
struct Artefact {
  physics::ScanArtefact cause;
  std::vector<Pressed> keys;
};

using enum physics::ScanArtefact;

const std::vector<Artefact> kArtefacts{{LostContact, {{ScanRow::Setpoint, -13}}},
                                       {Ringing, {{ScanRow::Gain, 1}}},
                                       {Parachuting, {{ScanRow::Setpoint, -4}, {ScanRow::Gain, -5}}},
                                       {Overload, {{ScanRow::Setpoint, -4}}},
                                       {DoubleTip, {{ScanRow::SecondApex, 1}}},
                                       {Drift, {{ScanRow::Drift, 5}}},
                                       {Noise, {{ScanRow::Noise, 4}}},
                                       {Blur, {{ScanRow::Setpoint, 2}, {ScanRow::Gain, -3}}},
                                       {BluntTip, {{ScanRow::TipRadius, 2}}}};

// The enum is the one list: the table of names and the phrases of the wall follow it.
TEST(ScanArtefacts, HaveTheirNameAndTheirPhraseInEveryLanguage) {
  const auto artefacts = core::kEnumerators<physics::ScanArtefact>;
  ASSERT_EQ(physics::kScanArtefacts.size(), artefacts.size());
  for (const LanguageRow& language : kLanguages) {
    const std::string file = fmt::format("{}/assets/guidance/{}.toml", support::source(), language.word);
    const Phrases phrases = Phrases::load(file).value();
    std::set<std::string> texts;
    for (std::size_t i = 0; i < artefacts.size(); ++i) {
      EXPECT_EQ(physics::kScanArtefacts[i].artefact, artefacts[i]);
      const Phrase phrase = after(Phrase::CauseNone, i);
      EXPECT_EQ(row_of(phrase).key, fmt::format("scan-cause-{}", physics::kScanArtefacts[i].name));
      EXPECT_TRUE(texts.insert(phrases[phrase]).second) << phrases[phrase];
    }
  }
}

class ScanOfAMaterial : public ::testing::TestWithParam<std::size_t> {};

TEST_P(ScanOfAMaterial, ShowsEveryArtefactNamesItsCauseAndIsCleanAgainAfterwards) {
  constexpr std::size_t kWithoutKeys = 3;  // none, and two of tapping mode, whose keys are in tapped_scan_test.cpp
  EXPECT_EQ(kArtefacts.size() + kWithoutKeys, core::kEnumerators<physics::ScanArtefact>.size())
      << "a new cause needs its keys here";
  constexpr double kLines = 10;  // number above that of the judged lines
  LiveScan scan = scan_of(GetParam());
  scan_lines(scan, kLines);
  ASSERT_EQ(cause_of(scan), None);
  for (const Artefact& artefact : kArtefacts) {
    const std::string where(physics::name_of(artefact.cause));
    for (const Pressed& key : artefact.keys) EXPECT_TRUE(scan.step(key.row, key.times)) << where;
    scan_lines(scan, kLines);
    EXPECT_EQ(core::index_of(cause_of(scan)), core::index_of(artefact.cause)) << where;
    for (const Pressed& key : artefact.keys) scan.step(key.row, -key.times);
    EXPECT_EQ(scan.choice(), scan.usual()) << where;
    // a tip that has let go was withdrawn by micrometres: it engages with the next frame at the latest
    scan_lines(scan, artefact.cause == LostContact ? LiveScan::kPixels + kLines : kLines);
    EXPECT_EQ(core::index_of(cause_of(scan)), core::index_of(None)) << "after " << where;
  }
}

INSTANTIATE_TEST_SUITE_P(Materials, ScanOfAMaterial, ::testing::Values(0U, 1U, 2U));

// ---- a surface that was measured ----

TEST(LiveScan, ScansAMeasuredSampleAsItIsDrawnAndABlunterTipHigher) {
  const support::ScratchFolder folder;
  std::vector<float> heights;
  for (int i = 0; i < 40 * 40; ++i) {
    heights.push_back(static_cast<float>(150e-9 * std::sin(0.9 * (i % 40)) * std::cos(0.5 * std::floor(i / 40.0))));
  }
  ExhibitFiles files;
  files.assets_dir = support::source("assets");
  files.sample = folder.write("scan.gsf", test::gsf_file("XRes = 40\nYRes = 40\nXReal = 2000\nYReal = 2000\n"
                                                         "XYUnits = nm\nZUnits = m\n",
                                                         heights));
  const auto measured = load_exhibit(files);
  ASSERT_TRUE(measured) << measured.error().message;
  const auto model = curves::make_sample_model(curves::ContactSetup{measured->materials.materials[kMica], {}, {}});
  const ScanSubject subject = scan_subject(measured->wall_scene, kMica, model.value());
  const double usual_m = subject.tip_radius_m, side_m = subject.side_m;
  EXPECT_NEAR(side_m, 0.92 * 39.0 / 40.0 * 2e-6, 0.03e-6) << "as it was measured, not as it is shown";
  const auto traced = subject.traced(usual_m), sharper = subject.traced(0.1 * usual_m),
             blunter = subject.traced(4.0 * usual_m);
  double relief_m = 0, raised_m = 0;
  for (int i = 0; i < 400; ++i) {
    const double x_m = side_m * (i % 20 / 19.0 - 0.5), y_m = side_m * (std::floor(i / 20.0) / 19.0 - 0.5);
    const double drawn_m = subject.drawn_m(x_m, y_m);
    ASSERT_EQ(traced(x_m, y_m), drawn_m);
    ASSERT_EQ(sharper(x_m, y_m), drawn_m);
    ASSERT_GE(blunter(x_m, y_m), drawn_m - 1e-18);
    relief_m = std::max(relief_m, std::abs(drawn_m));
    raised_m = std::max(raised_m, blunter(x_m, y_m) - drawn_m);
  }
  EXPECT_GT(relief_m, 150e-9) << "likewise";
  EXPECT_LT(relief_m, 450e-9);
  EXPECT_GT(raised_m, 0.001 * relief_m);
  LiveScan scan(subject);
  scan_lines(scan, 10);
  EXPECT_GT(measured_points(scan), 8 * LiveScan::kPixels);
  EXPECT_THAT(image_panel(scan, "", stage().phrases()).subtitle, testing::StartsWith("1.79 \u00b5m wide"));

  // the wall shows the sample on another scale
  const scene::TopographyScale shown = measured->wall_scene.topography_scale(kMica);
  EXPECT_LT(shown.lateral, 0.1);
  Moment moment;
  show_scan(scan, moment);
  EXPECT_NEAR((*moment.wall.scan_line)[1].x, 0.5 * shown.lateral * side_m, 1e-15);
  EXPECT_EQ(scan.surface_m(shown.lateral * 1e-7, 0.0), shown.vertical * traced(1e-7, 0.0));
  EXPECT_LT(std::abs(scan.apex_m().y), 0.5 * shown.lateral * side_m);
  EXPECT_NEAR(scan.apex_m().z, scan.surface_m(scan.apex_m().x, scan.apex_m().y), relief_m * shown.vertical);
}

// Over 100 um of waves the usual settings of a small image would let the tip fly over most of the waves.
TEST(LiveScan, BeginsSlowAndFirmEnoughForItsSubject) {
  constexpr double kSideM = 100e-6, kWave = 2.0 * 3.14159265358979 / 10e-6, kHighM = 40e-9;
  ScanSubject subject;
  subject.drawn_m = [](double x_m, double) { return kHighM * std::sin(kWave * x_m); };
  subject.traced = [&](double) { return subject.drawn_m; };
  subject.side_m = kSideM;
  subject.tip_radius_m = 10e-9;
  EXPECT_EQ(LiveScan(subject).usual(), ScanChoice{}) << "a slope of 0: those of a small image";
  subject.slope = kHighM * kWave;
  LiveScan scan(subject);
  EXPECT_LT(scan.usual().line_rate_hz, ScanChoice{}.line_rate_hz);
  EXPECT_GT(scan.usual().setpoint_n, ScanChoice{}.setpoint_n);
  scan_lines(scan, 10);
  EXPECT_EQ(cause_of(scan), physics::ScanArtefact::None);
  scan.step(ScanRow::SecondApex, 1);
  EXPECT_TRUE(LiveScan::valid(scan.progress())) << "a session takes it";
}

// ---- it grows line by line, in bounded time ----

TEST(LiveScan, GrowsLineByLineFromTheTop) {
  LiveScan scan = scan_of(kGold);
  EXPECT_EQ(measured_points(scan), 0U);
  scan_lines(scan, 20);
  const std::size_t lines = measured_points(scan) / LiveScan::kPixels;
  EXPECT_NEAR(static_cast<double>(lines), 20.0, 1.5);
  EXPECT_TRUE(std::isfinite(scan.maps().height_m[0].front()));
  EXPECT_TRUE(std::isnan(scan.maps().height_m[0].back()));
  EXPECT_NEAR(static_cast<double>(scan.row()), 20.0, 1.5);
}

TEST(LiveScan, ScansNoMoreThanABoundHoweverLateAFrameIs) {
  LiveScan scan = scan_of(kGold);
  scan.advance(3600.0);
  EXPECT_LE(measured_points(scan), LiveScan::kPixels * static_cast<std::size_t>(LiveScan::kMostCatchUpS * 10.0 + 1.0));
  const ScanProgress before = scan.progress();
  scan.advance(-1.0);
  EXPECT_EQ(scan.progress().pixel, before.pixel);
}

TEST(LiveScan, MeasuresTheSurfaceThatTheApexTraces) {
  LiveScan scan = scan_of(kMica);
  while (scan.step(ScanRow::Noise, -1)) {
  }
  scan_lines(scan, 30);
  const auto& map = scan.maps().height_m[0];
  const double side_m = scan.subject().side_m, pixel_m = side_m / LiveScan::kPixels;
  for (std::size_t column = 8; column < LiveScan::kPixels; ++column) {
    const double x_m = (static_cast<double>(column) + 0.5) * pixel_m - 0.5 * side_m;
    const double y_m = 0.5 * side_m - 20.5 * pixel_m;
    EXPECT_NEAR(map[20 * LiveScan::kPixels + column], scan.surface_m(x_m, y_m), 0.1e-9) << column;
  }
}

// ---- a session draws it again ----

TEST(LiveScan, IsTheSameAgainFromWhatASessionRecords) {
  LiveScan scan = scan_of(kMica);
  scan_lines(scan, 70);
  scan.step(ScanRow::TipRadius, -3);
  scan_lines(scan, 20);
  scan.step(ScanRow::Gain, 1);
  scan.step(ScanRow::Noise, 2);
  scan_lines(scan, 60);  // lines into the next frame
  scan.step(ScanRow::SecondApex, 1);
  scan.show_truth(true);
  for (int i = 0; i < 3; ++i) {
    scan_lines(scan, 55.3);
    Moment moment;
    show_scan(scan, moment);
    const servo::WallFrame frame = wall_frame_of(moment, 0, {});
    ASSERT_TRUE(frame.scan.has_value());
    const ScanProgress progress = scan_progress_of(frame);
    EXPECT_EQ(progress, scan.progress());
    ASSERT_TRUE(LiveScan::valid(progress));
    const LiveScan again(scan.subject(), progress);
    EXPECT_TRUE(same_images(scan, again)) << i;
    EXPECT_EQ(again.apex_m(), scan.apex_m()) << i;
    EXPECT_EQ(cause_of(again), cause_of(scan)) << i;
    EXPECT_EQ(image_panel(again, "", stage().phrases()), image_panel(scan, "", stage().phrases())) << i;
  }
  EXPECT_GE(scan.progress().frame, 2U);
  EXPECT_LE(scan.progress().changes.size(), 2U) << "what is no longer seen is forgotten";
}

TEST(LiveScan, RefusesARecordedProgressThatNoScanHas) {
  const ScanProgress good{
      .frame = 1, .pixel = 5, .truth = false, .changes = {{.frame = 0, .pixel = 0, .choice = {}}}, .hand = {}};
  EXPECT_TRUE(LiveScan::valid(good));
  ScanProgress bad = good;
  bad.changes.clear();
  EXPECT_FALSE(LiveScan::valid(bad));
  bad = good;
  bad.pixel = 2 * LiveScan::kPixels * LiveScan::kPixels + 1;
  EXPECT_FALSE(LiveScan::valid(bad));
  for (double ScanChoice::* value :
       {&ScanChoice::setpoint_n, &ScanChoice::gain_per_s, &ScanChoice::line_rate_hz, &ScanChoice::tip_radius_m,
        &ScanChoice::noise_m, &ScanChoice::drift_m_per_s, &ScanChoice::apex_distance_m}) {
    for (const double number : {std::nan(""), -1.0, 1e30, HUGE_VAL}) {
      bad = good;
      bad.changes.front().choice.*value = number;
      EXPECT_FALSE(LiveScan::valid(bad)) << number;
    }
  }
  bad = good;
  bad.changes.push_back({.frame = 1, .pixel = 3, .choice = {}});
  EXPECT_TRUE(LiveScan::valid(bad));
  bad.changes.push_back({.frame = 0, .pixel = 9, .choice = {}});
  EXPECT_FALSE(LiveScan::valid(bad)) << "out of order";
}

// ---- effects of tip and sample ----

TEST(LiveScan, ShowsThatABluntTipLeavesMoreUntouched) {
  LiveScan scan = scan_of(kGold);
  scan.show_truth(true);
  const double usual = scan.truth()->reach.unreached_share;
  scan.step(ScanRow::TipRadius, 2);
  scan_lines(scan, 2);
  EXPECT_GT(scan.truth()->reach.unreached_share, 1.5 * usual);
  scan.step(ScanRow::TipRadius, -7);
  scan_lines(scan, 2);
  EXPECT_LT(scan.truth()->reach.unreached_share, 0.02);
  EXPECT_TRUE(scan.truth()->revealed_tip.points_m.empty()) << "before there is a whole image";
  scan.show_truth(false);
  EXPECT_FALSE(scan.truth().has_value());
}

TEST(LiveScan, RevealsATipThatIsNowhereSharperThanTheTrueOne) {
  LiveScan scan = scan_of(kGold);
  while (scan.step(ScanRow::Noise, -1)) {
  }
  scan.step(ScanRow::Rate, -3);
  scan_lines(scan, 130);
  scan.show_truth(true);
  const auto& revealed = scan.truth()->revealed_tip.points_m;
  ASSERT_GT(revealed.size(), 10U);
  double widest_gap_m = 0;
  for (const glm::dvec2& point : revealed) {
    // places between the points of its grid touched, too
    const double beside_m = std::abs(point.x) + 2.0 * scan.subject().side_m / LiveScan::kPixels;
    EXPECT_LE(point.y, beside_m * beside_m / (2.0 * scan.choice().tip_radius_m) + 0.3e-9) << point.x;
    widest_gap_m = std::max(widest_gap_m, point.x * point.x / (2.0 * scan.choice().tip_radius_m) - point.y);
  }
  EXPECT_LT(widest_gap_m, 8e-9);
}

// ---- the wall ----

TEST(LiveScan, TakesThePlaceOfTheCurveAndTheTipFollowsUnlessTheHandHasIt) {
  LiveScan scan = scan_of(kGold);
  scan_lines(scan, 10);
  Moment moment;
  moment.wall.material = kGold;
  render::FrameState frame;
  stage().wall_scene.update(moment.wall, frame);
  const render::PanelPlacement place = frame.panels.force.placement;
  EXPECT_EQ(frame.panels.image.placement, render::kNoPlacement);
  show_scan(scan, moment);
  EXPECT_EQ(moment.wall.surface.xy_m[1], scan.apex_m().y);
  stage().wall_scene.update(moment.wall, frame);
  EXPECT_EQ(frame.panels.image.placement, place);
  EXPECT_EQ(frame.panels.force.placement, render::kNoPlacement);

  Moment held;
  held.wall.material = kGold;
  held.servo_state = scene::ServoState::Running;
  held.wall.surface.xy_m = {1e-9, 2e-9};
  show_scan(scan, held);
  EXPECT_EQ(held.wall.surface.xy_m[0], 1e-9);
  EXPECT_TRUE(held.wall.scan_line.has_value());
}

TEST(LiveScan, LeavesRoomForTheServosNodesWithEveryMaterialOnTheShelf) {
  ExhibitFiles files;
  files.assets_dir = support::source("assets");
  const auto library = scene::load_materials(files.assets_dir + "/materials.toml").value();
  for (const auto& material : library.materials) {
    if (files.shown.size() < kMostMaterials) files.shown.push_back(material.name);
  }
  ASSERT_EQ(files.shown.size(), kMostMaterials);
  EXPECT_LE(load_exhibit(files).value().wall_scene.scene().nodes.size(), scene::kMaxNodes);
}

}  // namespace live_scan_test
}  // namespace afm::exhibit
