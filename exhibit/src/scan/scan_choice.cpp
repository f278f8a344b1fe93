// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/scan_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/enumerators.h"
#include "curves/live_parameters.h"
#include "panels/panel_conventions.h"
#include "physics/quantity_text.h"
#include "physics/tapping/driven_lever.h"

namespace afm::exhibit {

namespace {

// Lever of the scan, in air or liquid: too stiff for any sample here to hold its tip down over all of its relief, so
// that a tip that is too slow does come off.
constexpr double kSpring = 5.0;
constexpr double kApexShare = 0.18;      // distance of a second apex, as a share of the side
constexpr double kFarthestApexM = 1e-5;  // see physics::kScanFields
constexpr double kApexHeightM = 0.0;     // height difference 0, so that both apexes image every bump

enum class Below { Nothing, Zero, Negative };

// A series 1, 2, 5, 10 between two ends; below it nothing, zero, or zero and the same series with a negative sign.
struct Series {
  double ScanChoice::* value;
  double low, high;
  Below below;
};

// Series in the order of ScanRow. The second apex has two values, and the rows of the drive depend on the lever.
constexpr std::array kSeries{
    Series{&ScanChoice::setpoint_n, 0.1e-9, 50e-9, Below::Negative},  // below zero only adhesion holds the tip
    Series{&ScanChoice::gain_per_s, 20.0, 20e3, Below::Nothing},
    Series{&ScanChoice::line_rate_hz, 1.0, 100.0, Below::Nothing},
    Series{&ScanChoice::tip_radius_m, 1e-9, 200e-9, Below::Nothing},
    Series{&ScanChoice::noise_m, 10e-12, 2e-9, Below::Zero},
    Series{&ScanChoice::drift_m_per_s, 0.1e-9, 50e-9, Below::Zero}};
static_assert(kSeries.size() + 3 == core::kEnumerators<ScanRow>.size());

constexpr double kSame = 1e-6;  // largest relative difference of equal values

constexpr double kSlowestUsualHz = 2.0;  // a minute per image; prefers a stronger force to a slower scan
constexpr double kMostLag = 0.5;         // fraction of the bend that adhesion can hold, so the tip stays on the sample

// Setpoint in tapping mode, in steps of a twentieth of the free amplitude.
constexpr double kStepsOfShare = 20.0, kLeastShare = 0.3, kMostShare = 0.95, kUsualShare = 0.8;
constexpr double kUsualTappingHz = 2.0;

// Drive of a tapping lever: free amplitudes relative to that at the start, within the range of its table of swings;
// frequencies relative to the half width of its resonance.
constexpr double kStepsOfAmplitude = 20.0, kLeastAmplitude = 0.3, kMostAmplitude = 1.2;
constexpr double kStepsOfWidth = 5.0, kMostWidths = 1.0;
constexpr double kSlack = 1e-9;  // relative tolerance for rounding
constexpr int kDigitsOfDrive = 6;

double half_width_hz(const physics::DrivenLever& lever) { return 0.5 * lever.resonance.si / lever.quality_factor; }
double drive_hz(const physics::DrivenLever& lever) { return lever.ratio * lever.resonance.si; }

double stepped_share(double share, int steps) {
  const double next = (std::round(share * kStepsOfShare) + steps) / kStepsOfShare;
  return std::clamp(next, kLeastShare, kMostShare);
}

// Next value of the series above or below a value, which need not belong to it.
double neighbour(double value, int direction) {
  const double decade = std::pow(10.0, std::floor(std::log10(value * (1.0 + kSame))));
  if (direction > 0) {
    for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
      if (factor * decade > value * (1.0 + kSame)) return factor * decade;
    }
  }
  for (const double factor : {5.0, 2.0, 1.0, 0.5}) {
    if (factor * decade < value * (1.0 - kSame)) return factor * decade;
  }
  return value;
}

double stepped(const Series& series, double value, int direction) {
  if (value < 0.0) return -stepped(series, -value, -direction);
  if (value == 0.0 && direction < 0) return series.below == Below::Negative ? -series.low : 0.0;
  if (value == 0.0) return series.low;
  const double next = neighbour(value, direction);
  if (direction < 0 && next < series.low * (1.0 - kSame)) return series.below == Below::Nothing ? value : 0.0;
  return next > series.high * (1.0 + kSame) ? value : next;
}

}  // namespace

bool in_tapping(const ScanChoice& choice) { return choice.setpoint_n >= 0.5 * kLeastShare; }

bool is_valid(const ScanChoice& choice) {
  constexpr double kSharpest = 1e-10, kBluntest = 1e-4;  // limits for tips defined by users
  if (!(choice.apex_distance_m >= 0.0 && choice.apex_distance_m <= kFarthestApexM)) return false;
  if (!(choice.free_amplitude_m >= 0.0 && std::isfinite(choice.free_amplitude_m))) return false;
  if (!(choice.drive_hz >= 0.0 && std::isfinite(choice.drive_hz))) return false;
  return std::all_of(kSeries.begin(), kSeries.end(), [&](const Series& series) {
    if (series.value == &ScanChoice::setpoint_n && in_tapping(choice)) {
      return choice.setpoint_n >= kLeastShare && choice.setpoint_n <= kMostShare;
    }
    const double value = choice.*series.value;
    const bool radius = series.value == &ScanChoice::tip_radius_m;
    const double low = radius ? kSharpest : series.low * (1.0 - kSame);
    const double high = radius ? kBluntest : series.high * (1.0 + kSame);
    const double size = series.below == Below::Negative ? std::abs(value) : value;
    return (size >= low && size <= high) || (series.below != Below::Nothing && value == 0.0);
  });
}

bool step(ScanChoice& choice, ScanRow row, int steps, double side_m) {
  if (row == ScanRow::FreeAmplitude || row == ScanRow::DriveFrequency) return false;
  const ScanChoice before = choice;
  if (row == ScanRow::SecondApex) {
    choice.apex_distance_m = steps > 0 ? std::min(kApexShare * side_m, kFarthestApexM) : 0.0;
    return choice != before;
  }
  if (row == ScanRow::Setpoint && in_tapping(choice)) {
    choice.setpoint_n = stepped_share(choice.setpoint_n, steps);
    return choice != before;
  }
  const Series& series = kSeries[core::index_of(row)];
  for (int i = 0; i < std::abs(steps); ++i) choice.*series.value = stepped(series, choice.*series.value, steps);
  return choice != before;
}

bool step_drive(ScanChoice& choice, ScanRow row, int steps, const physics::DrivenLever& own) {
  const ScanChoice before = choice;
  if (row == ScanRow::FreeAmplitude) {
    const double a0 = own.free_amplitude.si,
                 share = std::round(choice.free_amplitude_m / a0 * kStepsOfAmplitude) + steps;
    choice.free_amplitude_m = a0 * std::clamp(share / kStepsOfAmplitude, kLeastAmplitude, kMostAmplitude);
  } else if (row == ScanRow::DriveFrequency) {
    const double own_hz = drive_hz(own), step_hz = half_width_hz(own) / kStepsOfWidth;
    const double away = std::round((choice.drive_hz - own_hz) / step_hz) + steps;
    choice.drive_hz = own_hz + step_hz * std::clamp(away, -kMostWidths * kStepsOfWidth, kMostWidths * kStepsOfWidth);
  }
  return choice != before;
}

physics::DrivenLever driven_by(const ScanChoice& choice, const physics::DrivenLever& own) {
  const double a0 = own.free_amplitude.si, own_hz = drive_hz(own);
  const double amplitude_m = choice.free_amplitude_m > 0.0 ? choice.free_amplitude_m : a0;
  const double hz = choice.drive_hz > 0.0 ? choice.drive_hz : own_hz;
  if (amplitude_m == a0 && hz == own_hz) return own;
  const double widths = std::abs(hz - own_hz) / half_width_hz(own), share = amplitude_m / a0;
  if (!(share >= kLeastAmplitude - kSlack && share <= kMostAmplitude + kSlack))
    throw physics::UnphysicalValue("free_amplitude", "outside what the table of swings covers");
  if (!(widths <= kMostWidths + kSlack)) throw physics::UnphysicalValue("drive", "too far from the resonance");
  physics::DrivenLever driven =
      physics::driven_lever(own.spring_constant, {own.resonance, own.quality_factor, physics::Temperature()},
                            {physics::Length(amplitude_m), physics::Frequency(hz)});
  driven.harmonics = own.harmonics;
  return driven;
}

ScanChoice usual_choice(double tip_radius_m, double side_m, double slope, double adhesion_n) {
  ScanChoice choice{.tip_radius_m = tip_radius_m};
  const auto comes_off = [&] {
    const double lag_m = slope * 2.0 * side_m * choice.line_rate_hz / choice.gain_per_s;
    return lag_m > kMostLag * (choice.setpoint_n + adhesion_n) / kSpring;
  };
  while (comes_off() && choice.line_rate_hz > kSlowestUsualHz) step(choice, ScanRow::Rate, -1, side_m);
  while (comes_off() && step(choice, ScanRow::Setpoint, 1, side_m)) {
  }
  while (comes_off() && step(choice, ScanRow::Rate, -1, side_m)) {
  }
  return choice;
}

ScanChoice usual_tapping_choice(double tip_radius_m, double side_m, double slope, const physics::DrivenLever& lever) {
  ScanChoice choice{.setpoint_n = kUsualShare,
                    .line_rate_hz = kUsualTappingHz,
                    .tip_radius_m = tip_radius_m,
                    .free_amplitude_m = lever.free_amplitude.si,
                    .drive_hz = drive_hz(lever)};
  const double most_per_s = 0.25 / lever.relaxation().si;
  while (choice.gain_per_s > most_per_s && step(choice, ScanRow::Gain, -1, side_m)) {
  }
  const double most_lag_m = kMostLag * (1.0 - kUsualShare) * lever.free_amplitude.si;
  while (slope * 2.0 * side_m * choice.line_rate_hz / choice.gain_per_s > most_lag_m &&
         step(choice, ScanRow::Rate, -1, side_m)) {
  }
  return choice;
}

std::string value_text(const ScanChoice& choice, ScanRow row) {
  const auto text = [](double value, const physics::Units& units) {
    return curves::typographic(physics::format_si(value, units.units, kDigits));
  };
  switch (row) {
    case ScanRow::Setpoint:
      if (in_tapping(choice)) return fmt::format("{:.2f} A0", choice.setpoint_n);
      return text(choice.setpoint_n, physics::kForceUnits);
    case ScanRow::Gain:
      return fmt::format("{:g}/s", choice.gain_per_s);
    case ScanRow::Rate:
      return text(choice.line_rate_hz, physics::kFrequencyUnits);
    case ScanRow::TipRadius:
      return text(choice.tip_radius_m, physics::kLengthUnits);
    case ScanRow::Noise:
      return text(choice.noise_m, physics::kLengthUnits);
    case ScanRow::Drift:
      return fmt::format("{:.3g} nm/s", choice.drift_m_per_s * 1e9);
    case ScanRow::FreeAmplitude:
      return text(choice.free_amplitude_m, physics::kLengthUnits);
    case ScanRow::DriveFrequency:
      return curves::typographic(physics::format_si(choice.drive_hz, physics::kFrequencyUnits.units, kDigitsOfDrive));
    case ScanRow::SecondApex:
      break;
  }
  return choice.apex_distance_m > 0.0 ? text(choice.apex_distance_m, physics::kLengthUnits) : "";
}

physics::ScanSettings settings_of(const ScanChoice& choice, double adhesion_n) {
  physics::ScanSettings settings;
  settings.line_rate = physics::Frequency(choice.line_rate_hz);
  if (!in_tapping(choice)) settings.setpoint = physics::Force(choice.setpoint_n);
  settings.integral_gain = physics::Frequency(choice.gain_per_s);
  settings.spring_constant = physics::Stiffness(kSpring);
  settings.adhesion = physics::Force(adhesion_n);
  settings.noise = physics::Length(choice.noise_m);
  settings.drift_x = settings.drift_y = physics::Velocity(choice.drift_m_per_s);
  settings.second_apex_distance = physics::Length(choice.apex_distance_m);
  settings.second_apex_height = physics::Length(kApexHeightM);
  return settings;
}

}  // namespace afm::exhibit
