// SPDX-License-Identifier: Apache-2.0
#include "physics/imaging/scan_artefact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <tuple>
#include <vector>

#include "physics/imaging/morphology.h"
#include "physics/imaging/scan_truth.h"

namespace scan_artefact_test {

using namespace afm::physics;

// A slow scan of steps as high as an image shows without any artefact; lever of 0.1 N/m, 5 nm of setpoint.
ScanSettings good_settings() {
  ScanSettings settings;
  settings.line_rate = Frequency(1.0);
  return settings;
}

double hills(double x, double) { return 3e-9 * std::sin(x / 20e-9); }
double steps_down(double x, double) { return x < 0.0 ? 30e-9 : 0.0; }

ScanArtefact artefact_of(const ScanSettings& settings, const Scanner::Surface& surface) {
  ScanArea area;
  area.rows = 4;
  Scanner scanner(area, settings, surface);
  ScanLine line;
  NewestLines newest;
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(scanner.next_line(line));
    newest.add(line, scanner.time().si);
  }
  return main_artefact({settings, area, scanner.loop().largest_integral_gain()}, newest.evidence());
}

// One change of the settings brings the artefact, and taking it back removes it.
struct Cause {
  ScanArtefact artefact;
  std::function<void(ScanSettings&)> worsen;
  Scanner::Surface surface = hills;
};

TEST(ScanArtefact, ComesWithItsCauseAndGoesWithIt) {
  const Cause causes[] = {
      {ScanArtefact::LostContact, [](ScanSettings& s) { s.setpoint = Force(-1e-9); }},
      {ScanArtefact::Ringing, [](ScanSettings& s) { s.integral_gain = Frequency(4e3); }},
      {ScanArtefact::Parachuting, [](ScanSettings& s) { s.line_rate = Frequency(30.0); },
       [](double x, double) { return x < 0.0 ? -20e-9 * std::clamp(x / 40e-9, -1.0, 0.0) : 0.0; }},
      {ScanArtefact::Overload, [](ScanSettings& s) { s.setpoint = Force(0.02e-9); },
       [](double x, double) { return 6e-9 * std::clamp(x / 10e-9, 0.0, 1.0); }},
      {ScanArtefact::DoubleTip,
       [](ScanSettings& s) {
         s.second_apex_distance = Length(60e-9);
         s.second_apex_height = Length(1e-9);
       }},
      {ScanArtefact::Drift, [](ScanSettings& s) { s.drift_x = Velocity(10e-9); }},
      {ScanArtefact::Noise, [](ScanSettings& s) { s.noise = Length(2e-9); }},
      {ScanArtefact::Blur, [](ScanSettings& s) { s.integral_gain = Frequency(30.0); }},
  };
  std::set<ScanArtefact> seen{ScanArtefact::None, ScanArtefact::BluntTip,           // unknown to a scanner
                              ScanArtefact::StateFlips, ScanArtefact::Saturation};  // artefacts in tapping mode
  for (const Cause& cause : causes) {
    ScanSettings settings = good_settings();
    EXPECT_EQ(artefact_of(settings, cause.surface), ScanArtefact::None) << name_of(cause.artefact);
    cause.worsen(settings);
    EXPECT_EQ(artefact_of(settings, cause.surface), cause.artefact) << name_of(cause.artefact);
    seen.insert(cause.artefact);
  }
  EXPECT_EQ(seen.size(), kScanArtefacts.size());
}

TEST(ScanArtefact, OfASteepStepIsAParachuteUntilTheSetpointIsRaised) {
  ScanSettings settings = good_settings();
  EXPECT_EQ(artefact_of(settings, steps_down), ScanArtefact::Parachuting);
  settings.setpoint = Force(4e-9);
  EXPECT_EQ(artefact_of(settings, steps_down), ScanArtefact::None);
}

TEST(ScanArtefact, IsNoneWhereTheFeedbackIsOff) {
  ScanSettings settings = good_settings();
  settings.feedback = Feedback::Off;
  settings.setpoint = Force(4e-9);
  settings.integral_gain = Frequency(1e5);
  EXPECT_EQ(artefact_of(settings, hills), ScanArtefact::None);
}

double terraces(double x, double) { return 2e-9 * std::floor(x / 60e-9); }
double bumps(double x, double y) { return 0.3e-9 * std::exp(-2.0 * (std::sin(x / 30e-9) + std::cos(y / 40e-9))); }

struct Judged {
  double error_n = 0;  // rms of the error signal
  std::size_t ringing = 0;
};

Judged judged(const ScanSettings& settings, const Scanner::Surface& surface) {
  ScanArea area;
  area.columns = 64;
  area.rows = 6;
  Scanner scanner(area, settings, surface);
  NewestLines newest;
  Judged result;
  const ScanImage image = scan_frame(scanner, [&](const ScanLine& line) {
    newest.add(line, scanner.time().si);
    const ScanArtefact artefact =
        main_artefact({settings, area, scanner.loop().largest_integral_gain()}, newest.evidence());
    if (artefact == ScanArtefact::Ringing) ++result.ringing;
    return true;
  });
  const std::vector<double>& error = image.channels[2].values;
  for (const double value : error) result.error_n += value * value / static_cast<double>(error.size());
  result.error_n = std::sqrt(result.error_n);
  return result;
}

// The advice is a lower gain, so that gain must give a better image.
TEST(ScanArtefact, IsRingingOnlyWhereALowerGainHasASmallerError) {
  for (const Scanner::Surface& surface :
       {Scanner::Surface(hills), Scanner::Surface(terraces), Scanner::Surface(bumps)}) {
    for (const double rate_hz : {2.0, 10.0}) {
      for (const double noise_m : {0.0, 200e-12}) {
        for (const double delay_s : {0.0, 40e-6}) {
          double clean_n = HUGE_VAL;  // error at the next lower gain without an artefact
          std::size_t named = 0, highest_clean = 0;
          for (std::size_t gain = 500; gain <= 5000; gain += 250) {
            ScanSettings settings;
            settings.line_rate = Frequency(rate_hz);
            settings.noise = Length(noise_m);
            settings.detector_delay = Time(delay_s);
            settings.integral_gain = Frequency(static_cast<double>(gain));
            const auto [error_n, ringing] = judged(settings, surface);
            if (ringing > 0) {
              EXPECT_GT(error_n, clean_n) << gain << "/s at " << rate_hz << " Hz, " << noise_m << " m";
              ++named;
            } else {
              clean_n = error_n;
              highest_clean = gain;
            }
          }
          EXPECT_GE(highest_clean, 3000U) << "up to w0/Q, 3142/s, the error falls";
          // a delay of a fifth of its period damps this resonance
          EXPECT_EQ(named, delay_s > 0.0 ? 0U : 8U) << rate_hz << " Hz, " << noise_m << " m";
        }
      }
    }
  }
}

TEST(ScanArtefact, IsNoDriftAndNoNoiseThatNobodySees) {
  const auto flat = [](double, double) { return 0.0; };
  ScanSettings settings = good_settings();
  settings.drift_x = Velocity(10e-9);
  EXPECT_EQ(artefact_of(settings, flat), ScanArtefact::None) << "drift over a plane";
  settings.integral_gain = Frequency(30.0);
  EXPECT_EQ(artefact_of(settings, flat), ScanArtefact::None) << "a slow loop over a plane";
  settings = good_settings();
  settings.noise = Length(2e-9);
  EXPECT_EQ(artefact_of(settings, flat), ScanArtefact::Noise) << "noise over a plane is all that is seen";
  settings.drift_x = Velocity(10e-9);
  EXPECT_EQ(artefact_of(settings, flat), ScanArtefact::Noise) << "drift of noise alone";
  // a relief that dwarfs the noise
  settings = good_settings();
  settings.noise = Length(2e-9);
  EXPECT_EQ(artefact_of(settings, [](double x, double) { return 100e-9 * std::sin(x / 80e-9); }), ScanArtefact::None);
}

TEST(ScanTruth, AddsWhatTheTipReachedAndWhatItIs) {
  // spikes on a plane, imaged by a parabola of 2 nm, a pixel a nanometre
  HeightGrid surface;
  surface.columns = surface.rows = 64;
  surface.column_step_m = surface.row_step_m = 1e-9;
  surface.height_m.assign(64 * 64, 0.0);
  for (std::size_t i = 0; i < 9; ++i) surface.at(8 + 24 * (i % 3), 8 + 24 * (i / 3)) = 20e-9;
  const TipShape tip{.kind = TipKind::Paraboloid, .radius = Length(2e-9)};

  ScanImage image;
  image.columns = image.rows = 64;
  image.width_m = image.height_m = 64e-9;
  image.channels = {{"Height", "m", image_of(surface, tip).height_m}};
  add_truth(tip, Length(), image);
  ASSERT_EQ(image.channels.size(), 4U);
  const auto& [height, reconstruction, certainty, blind] =
      std::tie(image.channels[0], image.channels[1], image.channels[2], image.channels[3]);
  EXPECT_EQ(reconstruction.name, "Reconstruction");
  std::size_t certain = 0;
  for (std::size_t k = 0; k < surface.height_m.size(); ++k) {
    ASSERT_GE(reconstruction.values[k], surface.height_m[k] - 1e-20);
    ASSERT_LE(reconstruction.values[k], height.values[k]);
    if (certainty.values[k] == 0.0) continue;
    ASSERT_NEAR(reconstruction.values[k], surface.height_m[k], 1e-15);
    ++certain;
  }
  EXPECT_GT(certain, 1000U);
  EXPECT_LT(certain, 4000U);
  for (int u = -4; u <= 4; ++u) {
    const auto beside = static_cast<std::size_t>(32 * 64 + 32 + u);
    EXPECT_NEAR(blind.values[beside], -u * u * 1e-18 / (2.0 * 2e-9), 1e-20) << "a spike shows the tip";
  }
}

}  // namespace scan_artefact_test
