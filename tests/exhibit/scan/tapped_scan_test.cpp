// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/enumerators.h"
#include "core/fnv1a.h"
#include "exhibit/cluster/wall_history.h"
#include "exhibit/scan/live_scan.h"
#include "exhibit/scan/scan_cause.h"
#include "exhibit/scan/scan_panels.h"
#include "exhibit/scan/scan_subject.h"
#include "scanned_sample.h"
#include "support/samples/tapped_sample.h"

// The scan that the live wall shows under a lever that taps, driven as the keys drive it.
namespace afm::exhibit {
namespace tapped_scan_test {

constexpr std::size_t kMica = 0, kGold = 1;
constexpr double kFrameS = 1.0 / 60.0;

void scan_lines(LiveScan& scan, double lines) {
  const double seconds = lines / scan.choice().line_rate_hz;
  for (double t = 0; t < seconds; t += kFrameS) scan.advance(kFrameS);
}

// NaN equals NaN.
bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

struct Pressed {
  ScanRow row;
  int times;  // number of presses of +, or of - if negative
};
struct Artefact {
  physics::ScanArtefact cause;
  std::vector<Pressed> keys;
};

using enum physics::ScanArtefact;

// The sample of docs/tapping.md on the steps of gold.
LiveScan tapped_scan() { return LiveScan(scan_subject(stage().wall_scene, kGold, test::tapped_sample())); }

// Scan of another surface on that square: the drawn samples are too flat to stop a swing of 20 nm.
LiveScan scan_of(const std::function<double(double share)>& height_m) {
  ScanSubject subject = scan_subject(stage().wall_scene, kGold, test::tapped_sample());
  const auto surface = [height_m, side_m = subject.side_m](double x_m, double) { return height_m(x_m / side_m); };
  subject.traced = [surface](double) { return surface; };
  return LiveScan(std::move(subject));
}

double hills_m(double share) { return 10e-9 * std::cos(4.0 * std::numbers::pi * share); }
double particle_m(double share) { return std::abs(share) < 0.04 ? 3e-9 : 0.0; }

TEST(TappedScan, IsTakenByALeverThatTaps) {
  LiveScan scan = tapped_scan();
  ASSERT_TRUE(scan.is_tapped());
  EXPECT_EQ(scan.choice().setpoint_n, 0.8);
  EXPECT_LE(scan.choice().gain_per_s, 589.0) << "w0/(8Q), without overshoot";
  scan_lines(scan, 3.0);
  const Phrases& phrases = stage().phrases();
  const render::ImagePanel panel = image_panel(scan, "Mica", phrases);
  EXPECT_THAT(panel.subtitle, ::testing::HasSubstr("tapping, A0 20 nm"));
  EXPECT_THAT(panel.heights[1].title, ::testing::StartsWith("Phase"));
  EXPECT_THAT(scan_panel(scan, "Mica", phrases).rows.front().value, ::testing::HasSubstr("0.80 A0"));
  EXPECT_THAT(image_panel(exhibit::scan_of(kMica), "Mica", phrases).subtitle,
              ::testing::Not(::testing::HasSubstr("tapping")));
  Moment moment;
  show_scan(scan, moment);
  EXPECT_NEAR(moment.wall.swing.amplitude_m, 16e-9, 1e-9);
  EXPECT_GT(moment.wall.swing.phase_rad, 0.0);
}

TEST(TappedScan, KeepsAnotherAmplitudeFromTheNextPixelOnAndReplaysIt) {
  LiveScan scan = tapped_scan();
  scan_lines(scan, 2.3);
  EXPECT_TRUE(scan.step(ScanRow::Setpoint, -4));
  EXPECT_DOUBLE_EQ(scan.choice().setpoint_n, 0.6);
  scan_lines(scan, 4.0);
  EXPECT_NEAR(scan.scanner().loop().tapping()->setpoint_m(), 12e-9, 1e-15);
  EXPECT_NEAR(scan.scanner().loop().tapping()->amplitude_m(), 12e-9, 1e-9);
  EXPECT_TRUE(LiveScan::valid(scan.progress()));
  const LiveScan again(scan.subject(), scan.progress());
  EXPECT_TRUE(same(scan.maps().height_m[0], again.maps().height_m[0]));
  for (std::size_t pass = 0; pass < 2; ++pass) {
    EXPECT_TRUE(same(scan.maps().phase_deg[pass], again.maps().phase_deg[pass]));
    EXPECT_TRUE(same(scan.maps().energy_j[pass], again.maps().energy_j[pass]));
  }
  EXPECT_FALSE(scan.step(ScanRow::Setpoint, 1000) && scan.step(ScanRow::Setpoint, 1)) << "0.95 is the last";
}

// A drive that changes while the lever taps, from the next pixel on.
TEST(TappedScan, ChangesFreeAmplitudeAndDriveWhileItScansAndReplaysThem) {
  LiveScan scan = tapped_scan();
  ASSERT_EQ(scan.rows().size(), exhibit::scan_of(kMica).rows().size() + 2) << "contact mode has no drive";
  const Phrases& phrases = stage().phrases();
  const auto shown = [&](ScanRow row) { return scan_panel(scan, "Mica", phrases).rows.at(core::index_of(row)).value; };
  EXPECT_EQ(shown(ScanRow::FreeAmplitude), "20 nm");
  EXPECT_EQ(shown(ScanRow::DriveFrequency), "300 kHz");
  scan_lines(scan, 2.3);
  EXPECT_TRUE(scan.step(ScanRow::FreeAmplitude, -5));
  scan_lines(scan, 3.1);
  EXPECT_EQ(shown(ScanRow::FreeAmplitude), "15 nm");
  EXPECT_THAT(image_panel(scan, "Mica", phrases).subtitle, ::testing::HasSubstr("tapping, A0 15 nm"));
  EXPECT_NEAR(scan.scanner().loop().tapping()->setpoint_m(), 0.8 * 15e-9, 1e-15);
  EXPECT_NEAR(scan.scanner().loop().tapping()->amplitude_m(), 0.8 * 15e-9, 0.5e-9);
  // a fifth of the half width of 375 Hz a step
  EXPECT_TRUE(scan.step(ScanRow::DriveFrequency, -2));
  scan_lines(scan, 3.0);
  EXPECT_EQ(shown(ScanRow::DriveFrequency), "299.85 kHz");
  EXPECT_NEAR(scan.scanner().loop().tapping()->lever().ratio, 299.85 / 300.0, 1e-9);
  EXPECT_TRUE(LiveScan::valid(scan.progress()));
  const LiveScan again(scan.subject(), scan.progress());
  EXPECT_TRUE(same(scan.maps().height_m[0], again.maps().height_m[0]));
  EXPECT_TRUE(same(scan.maps().phase_deg[1], again.maps().phase_deg[1]));
  scan.step(ScanRow::DriveFrequency, 1000);
  EXPECT_EQ(shown(ScanRow::DriveFrequency), "300.375 kHz");
  EXPECT_FALSE(scan.step(ScanRow::DriveFrequency, 1)) << "a half width";
  scan.step(ScanRow::FreeAmplitude, 1000);
  EXPECT_EQ(shown(ScanRow::FreeAmplitude), "24 nm");
  scan.reset();
  EXPECT_EQ(scan.choice(), scan.usual());
}

// A recording from before there were such rows has the lever's own drive.
TEST(TappedScan, KeepsItsDriveWithoutOne) {
  LiveScan scan = tapped_scan();
  ScanProgress older = scan.progress();
  older.changes.front().choice.free_amplitude_m = older.changes.front().choice.drive_hz = 0.0;
  ASSERT_TRUE(LiveScan::valid(older));
  EXPECT_EQ(LiveScan(scan.subject(), older).choice(), scan.usual());
}

// Another machine of the wall receives each change as a record, in any of its frames.
TEST(TappedScan, HasTheSameImageOnAnotherMachineAfterChangesOfItsDrive) {
  LiveScan scan = tapped_scan();
  LiveScan there(scan.subject());
  std::vector<cluster::ScanRecord> records;
  const auto send = [&] {
    const ScanChange& newest = scan.progress().changes.back();
    records.push_back(record_of(newest, kGold, {}));
    ASSERT_TRUE(there.follow(newest.frame, newest.pixel));
    there.choose(change_of(records.back()).choice);
  };
  send();
  scan_lines(scan, 1.4);
  ASSERT_TRUE(scan.step(ScanRow::FreeAmplitude, -5));
  send();
  scan_lines(scan, 1.2);
  ASSERT_TRUE(scan.step(ScanRow::DriveFrequency, -2));
  send();
  scan_lines(scan, 1.7);
  ASSERT_TRUE(there.follow(scan.progress().frame, scan.progress().pixel));
  EXPECT_EQ(there.choice(), scan.choice());
  // a machine that joins later
  ScanProgress joined{.frame = scan.progress().frame, .pixel = scan.progress().pixel, .changes = {}, .hand = {}};
  for (const cluster::ScanRecord& record : records) joined.changes.push_back(change_of(record));
  const LiveScan late(scan.subject(), joined);
  for (const LiveScan* const other : {&std::as_const(there), &late}) {
    EXPECT_TRUE(same(scan.maps().height_m[0], other->maps().height_m[0]));
    EXPECT_TRUE(same(scan.maps().phase_deg[0], other->maps().phase_deg[0]));
    EXPECT_TRUE(same(scan.maps().error_n[1], other->maps().error_n[1]));
  }
}

// In units far below a height that anyone measures, and far above the last bit of a cosine.
std::uint64_t digest_of(const ScanMaps& maps) {
  core::Fnv1a digest;
  const auto add = [&digest](const std::vector<double>& values, double unit) {
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      const auto units = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::nearbyint(value / unit)));
      for (int shift = 0; shift < 64; shift += 8) digest.add(static_cast<unsigned char>(units >> shift));
    }
  };
  for (std::size_t pass = 0; pass < 2; ++pass) {
    add(maps.height_m[pass], 1e-15);
    add(maps.phase_deg[pass], 1e-6);
  }
  return digest.value();
}

// The hills with a drive beside the resonance, in two parts.
std::uint64_t digest_beside_resonance(physics::Harmonics harmonics) {
  ScanSubject subject = scan_of(hills_m).subject();
  subject.tapped->lever.harmonics = harmonics;
  LiveScan scan(std::move(subject));
  scan_lines(scan, 3.0);
  EXPECT_TRUE(scan.step(ScanRow::DriveFrequency, 4));
  scan_lines(scan, 2.0);
  return digest_of(scan.maps());
}

TEST(TappedScan, HasTheHarmonicsOfItsDriveAndInOlderSessionsThoseAtTheResonance) {
  // computed by the program that had no other harmonics
  constexpr std::uint64_t kBeforeVersion21 = 13633114729344374401U;
  EXPECT_EQ(digest_beside_resonance(physics::Harmonics::AtResonance), kBeforeVersion21);
  EXPECT_NE(digest_beside_resonance(physics::Harmonics::OfTheDrive), kBeforeVersion21);
}

void expect_named(LiveScan scan, const std::vector<Artefact>& artefacts) {
  constexpr double kLines = 10;
  scan_lines(scan, kLines);
  ASSERT_EQ(physics::name_of(cause_of(scan)), "none");
  for (const Artefact& artefact : artefacts) {
    const std::string where(physics::name_of(artefact.cause));
    for (const Pressed& key : artefact.keys) EXPECT_TRUE(scan.step(key.row, key.times)) << where;
    scan_lines(scan, kLines);
    EXPECT_EQ(physics::name_of(cause_of(scan)), where);
    for (const Pressed& key : artefact.keys) scan.step(key.row, -key.times);
    EXPECT_EQ(scan.choice(), scan.usual()) << where;
    scan_lines(scan, kLines);
    EXPECT_EQ(physics::name_of(cause_of(scan)), "none") << "after " << where;
  }
}

TEST(TappedScan, NamesWhatATappingLeverShowsAndIsCleanAgainAfterwards) {
  expect_named(scan_of(hills_m), {{Parachuting, {{ScanRow::Setpoint, 3}}},
                                  {Saturation, {{ScanRow::Setpoint, -10}, {ScanRow::Rate, 2}}},
                                  {Blur, {{ScanRow::Rate, 1}}}});
  expect_named(scan_of(particle_m), {{StateFlips, {{ScanRow::Setpoint, 2}}}});
}

// The tables of a lever that taps have its push; F_ad of DMT is 4 pi R times the mean surface energy.
TEST(TappedScan, IsTakenInContactByAHandBesideALeverThatTaps) {
  const LiveScan scan(scan_subject(stage().wall_scene, kMica, test::tapped_sample()),
                      HandPart{.paints = true, .feedback = true, .side_m = 100e-9, .first_tick = 0});
  EXPECT_FALSE(scan.is_tapped());
  EXPECT_NEAR(scan.subject().adhesion_n, 2.0 * std::numbers::pi * 20e-9 * 62.4e-3, 0.02 * 7.84e-9);
}

}  // namespace tapped_scan_test
}  // namespace afm::exhibit
