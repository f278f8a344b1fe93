// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "physics/imaging/scan_settings.h"

namespace afm::exhibit {

// The settings of a scan that the wall's panel offers, row by row.
enum class ScanRow { Setpoint, Gain, Rate, TipRadius, Noise, Drift, SecondApex };

// Their values. The tip's radius makes the surface that the apex traces; the others are the microscope's.
struct ScanChoice {
  double setpoint_n = 2e-9;
  double gain_per_s = 2000;  // of the integral controller
  double line_rate_hz = 10;
  double tip_radius_m = 10e-9;
  double noise_m = 20e-12;     // rms, as in physics::ScanSettings
  double drift_m_per_s = 0;    // to the right and upwards alike
  double apex_distance_m = 0;  // of a second apex; 0: there is none

  bool operator==(const ScanChoice&) const = default;
};

// True for values that a scan can have: finite, within the ranges of physics::kScanFields and of the rows.
bool is_valid(const ScanChoice& choice);

// The next value of the row's series, 1, 2, 5, 10 and so on, `steps` further; stays at its ends. `side_m` is the
// scanned square's, which gives the distance of a second apex. True if something changed.
bool step(ScanChoice& choice, ScanRow row, int steps, double side_m);

// The settings that a scan of a square of `side_m` begins with: slow and firm enough that the loop, which lags behind
// by the speed of the heights over its gain, keeps the tip on slopes up to `slope`.
ScanChoice usual_choice(double tip_radius_m, double side_m, double slope, double adhesion_n);

// "1 nN", "500 pm"; a decimal point as in English.
std::string value_text(const ScanChoice& choice, ScanRow row);

// Lever and microscope for these values; `adhesion_n` is the sample's pull-off force, a magnitude.
physics::ScanSettings settings_of(const ScanChoice& choice, double adhesion_n);

}  // namespace afm::exhibit
