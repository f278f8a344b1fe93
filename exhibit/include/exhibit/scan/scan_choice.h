// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "physics/imaging/scan_settings.h"

namespace afm::physics {
struct DrivenLever;
}

namespace afm::exhibit {

// Rows of the scan's settings on the wall's panel; the last two only in tapping mode.
enum class ScanRow { Setpoint, Gain, Rate, TipRadius, Noise, Drift, SecondApex, FreeAmplitude, DriveFrequency };

// Values of the settings. The tip's radius determines the traced surface; the others belong to the microscope.
struct ScanChoice {
  double setpoint_n = 2e-9;  // force; in tapping mode a fraction of the free amplitude, see in_tapping()
  double gain_per_s = 2000;  // gain of the integral controller
  double line_rate_hz = 10;
  double tip_radius_m = 10e-9;
  double noise_m = 20e-12;      // rms noise, see physics::ScanSettings
  double drift_m_per_s = 0;     // speed of the drift, equal to the right and upwards
  double apex_distance_m = 0;   // distance of a second apex; 0: no second apex
  double free_amplitude_m = 0;  // free amplitude in tapping mode; 0: as at the start of the scan
  double drive_hz = 0;          // frequency of the drive; 0: as at the start of the scan

  bool operator==(const ScanChoice&) const = default;
};

// True if the setpoint is an amplitude: no force has such a large number.
bool in_tapping(const ScanChoice& choice);

// Returns whether all values are finite and within the ranges of physics::kScanFields and of the rows.
bool is_valid(const ScanChoice& choice);

// Changes the row's value by `steps` along its series 1, 2, 5, 10 and so on, up to the series' ends. `side_m` is the
// side of the scanned square, which determines the distance of a second apex. Returns whether anything changed.
// No effect on the rows of tapping mode: see step_drive().
bool step(ScanChoice& choice, ScanRow row, int steps, double side_m);

// Changes the free amplitude in steps of a twentieth of that of `own`, from 0.3 to 1.2 of it, or the drive in steps of
// a fifth of the half width f0/2Q of the resonance, up to one half width beside the drive of `own`. Returns whether
// anything changed.
bool step_drive(ScanChoice& choice, ScanRow row, int steps, const physics::DrivenLever& own);

// The lever with the drive of these settings. Throws UnphysicalValue unless both are within the reach of step_drive().
physics::DrivenLever driven_by(const ScanChoice& choice, const physics::DrivenLever& own);

// Initial settings for a square of `side_m`: slow and firm enough that the loop, whose lag is the heights' rate of
// change divided by its gain, keeps the tip on slopes up to `slope`.
ScanChoice usual_choice(double tip_radius_m, double side_m, double slope, double adhesion_n);

// Same for tapping mode: at the gain at which its envelope does not overshoot.
ScanChoice usual_tapping_choice(double tip_radius_m, double side_m, double slope, const physics::DrivenLever& lever);

// Text of a value with a decimal point: "1 nN", "500 pm", "0.80 A0", "300.075 kHz".
std::string value_text(const ScanChoice& choice, ScanRow row);

// Settings of lever and microscope; in tapping mode without the setpoint. `adhesion_n` is the sample's pull-off force,
// a magnitude.
physics::ScanSettings settings_of(const ScanChoice& choice, double adhesion_n);

}  // namespace afm::exhibit
