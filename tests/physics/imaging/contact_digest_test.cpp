// SPDX-License-Identifier: Apache-2.0
// Invariant: images in contact mode are those of the versions before tapping
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "core/fnv1a.h"
#include "physics/imaging/scanner.h"

namespace contact_digest_test {

using namespace afm::physics;

// Steps, a slope and a bump, by arithmetic that every library computes alike.
double ground_m(double x_m, double y_m) {
  const double step_m = std::fmod(std::abs(x_m), 120e-9) < 60e-9 ? 4e-9 : 0.0;
  const double from_m2 = (x_m - 40e-9) * (x_m - 40e-9) + (y_m + 30e-9) * (y_m + 30e-9);
  return step_m + 0.01 * x_m + 0.02 * y_m + 6e-9 / (1.0 + from_m2 / 4e-16);
}

// Digest in units far below any measurable force or height, and far above the last bit of a cosine.
std::uint64_t digest_of(const ScanImage& image) {
  afm::core::Fnv1a digest;
  for (const ImageChannel& channel : image.channels) {
    const double unit = channel.unit == "m" ? 0x1p-70 : 0x1p-70 * 0.1;
    for (const char byte : channel.name) digest.add(static_cast<unsigned char>(byte));
    for (const double value : channel.values) {
      const auto units = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::nearbyint(value / unit)));
      for (int shift = 0; shift < 64; shift += 8) digest.add(static_cast<unsigned char>(units >> shift));
    }
  }
  return digest.value();
}

std::uint64_t image_with(void (*change)(ScanSettings&), SlowDirection direction = SlowDirection::Down) {
  ScanArea area;
  area.columns = area.rows = 32;
  ScanSettings settings;
  settings.loop_rate = Frequency(20e3);
  change(settings);
  Scanner scanner(area, settings, ground_m, 7);
  if (direction == SlowDirection::Up) scanner.begin_frame(direction);
  return digest_of(scan_frame(scanner));
}

TEST(ContactImages, AreThoseOfVersionsWithoutTapping) {
  // digest computed by the program before it had tapping mode
  EXPECT_EQ(image_with([](ScanSettings&) {}), 7880914753524955586U);
  EXPECT_EQ(image_with(
                [](ScanSettings& s) {
                  s.noise = Length(0.05e-9);
                  s.drift_x = Velocity(0.2e-9);
                  s.drift_y = Velocity(0.3e-9);
                },
                SlowDirection::Up),
            7124019997838293292U);
  EXPECT_EQ(image_with([](ScanSettings& s) {
              s.second_apex_distance = Length(30e-9);
              s.second_apex_height = Length(1e-9);
              s.snap_in = Length(1e-9);
              s.integral_gain = Frequency(4000.0);
              s.detector_delay = Time(100e-6);
            }),
            11438860558293660103U);
  EXPECT_EQ(image_with([](ScanSettings& s) {
              s.feedback = Feedback::Off;
              s.adhesion = Force(2e-9);
            }),
            17420825247098630643U);
}

}  // namespace contact_digest_test
