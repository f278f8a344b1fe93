// SPDX-License-Identifier: Apache-2.0
#include "physics/imaging/scan_settings.h"

#include <cmath>

#include "physics/contact_parameters.h"
#include "require_range.h"

namespace afm::physics {
namespace {

constexpr std::array kDrifts{Unit{"um/s", 1e6, true}, Unit{"\u00b5m/s", 1e6, false}, Unit{"nm/s", 1e9, true},
                             Unit{"pm/s", 1e12, true}};
constexpr std::array kGains{Unit{"/ms", 1e-3, true}, Unit{"/s", 1.0, true}};

constinit const Units kDriftUnits{"a velocity", kDrifts};
constinit const Units kGainUnits{"a gain", kGains};

template <int Kg, int M, int S>
double& si_of(Quantity<Kg, M, S>& quantity) {
  return quantity.si;
}
double& si_of(double& number) { return number; }

template <auto Member>
constexpr ScanField scan_field(std::string_view name, std::string_view option, std::string_view json_key,
                               std::string_view help, double smallest, double largest, const Units& units) {
  return {name,
          option,
          json_key,
          help,
          smallest,
          largest,
          &units,
          [](const ScanSettings& settings) {
            ScanSettings copy = settings;
            return si_of(copy.*Member);
          },
          [](ScanSettings& settings, double si) { si_of(settings.*Member) = si; }};
}

}  // namespace

constinit const std::array<ScanField, kScanFieldCount> kScanFields{
    scan_field<&ScanSettings::line_rate>("line_rate", "rate", "line_rate_Hz", "lines a second, each there and back",
                                         1e-3, 1e4, kFrequencyUnits),
    scan_field<&ScanSettings::setpoint>("setpoint", "setpoint", "setpoint_N", "force that the feedback keeps", -1e-5,
                                        1e-5, kForceUnits),
    scan_field<&ScanSettings::integral_gain>("integral_gain", "integral-gain", "integral_gain_per_s",
                                             "integral gain of the feedback", 0.0, 1e6, kGainUnits),
    scan_field<&ScanSettings::proportional_gain>("proportional_gain", "proportional-gain", "proportional_gain",
                                                 "proportional gain of the feedback", 0.0, 10.0, kPlainNumber),
    scan_field<&ScanSettings::loop_rate>("loop_rate", "loop-rate", "loop_rate_Hz", "steps of the feedback a second",
                                         1e3, 1e7, kFrequencyUnits),
    scan_field<&ScanSettings::detector_delay>("detector_delay", "detector-delay", "detector_delay_s",
                                              "age of the deflection that the feedback sees", 0.0, 1e-3, kTimeUnits),
    scan_field<&ScanSettings::z_resonance>("z_resonance", "z-resonance", "z_resonance_Hz",
                                           "resonance of the z scanner; 0Hz for an ideal one", 0.0, 1e6,
                                           kFrequencyUnits),
    scan_field<&ScanSettings::z_quality_factor>("z_quality_factor", "z-quality-factor", "z_quality_factor",
                                                "quality factor of that resonance", 0.1, 1000.0, kPlainNumber),
    scan_field<&ScanSettings::z_range>("z_range", "z-range", "z_range_m", "travel of the z scanner", 1e-9, 1e-3,
                                       kLengthUnits),
    scan_field<&ScanSettings::spring_constant>("spring_constant", "spring-constant", "spring_constant_N_per_m",
                                               "of the lever", 1e-4, 1e4, kStiffnessUnits),
    scan_field<&ScanSettings::adhesion>("adhesion", "adhesion", "adhesion_N", "pull at which the tip lets go", 0.0,
                                        1e-5, kForceUnits),
    scan_field<&ScanSettings::snap_in>("snap_in", "snap-in", "snap_in_m", "gap at which a free tip snaps in", 0.0, 1e-7,
                                       kLengthUnits),
    scan_field<&ScanSettings::friction>("friction", "friction-coefficient", "friction_coefficient",
                                        "coefficient of friction, for the lateral force", 0.0, 2.0, kPlainNumber),
    scan_field<&ScanSettings::noise>("noise", "noise", "noise_m", "rms noise of the deflection within 1 kHz", 0.0, 1e-8,
                                     kLengthUnits),
    scan_field<&ScanSettings::drift_x>("drift_x", "drift-x", "drift_x_m_per_s", "drift of the sample to the right",
                                       -1e-6, 1e-6, kDriftUnits),
    scan_field<&ScanSettings::drift_y>("drift_y", "drift-y", "drift_y_m_per_s", "drift of the sample upwards", -1e-6,
                                       1e-6, kDriftUnits),
    scan_field<&ScanSettings::second_apex_distance>(
        "second_apex_distance", "second-apex-distance", "second_apex_distance_m",
        "distance of a second apex to the right; 0nm for none", 0.0, 1e-5, kLengthUnits),
    scan_field<&ScanSettings::second_apex_height>("second_apex_height", "second-apex-height", "second_apex_height_m",
                                                  "height of the second apex above the first", 0.0, 1e-6, kLengthUnits),
};
static_assert(sizeof(ScanSettings) == (kScanFieldCount + 1) * sizeof(double),
              "every number of ScanSettings needs one row in kScanFields");

void validate(const ScanSettings& settings) {
  for (const ScanField& field : kScanFields) {
    require_range(std::string(field.name), field.get(settings), field.smallest, field.largest, *field.units);
  }
}

Length noise_of_height(const ScanSettings& settings) noexcept {
  if (settings.feedback == Feedback::Off) return Length();
  return settings.noise * std::sqrt(settings.integral_gain / (4.0 * kNoiseBandwidth));
}

void validate(const ScanArea& area) {
  constexpr Length kSmallest(1e-12), kLargest(1e-2);
  require_range("width", area.width, kSmallest, kLargest, kLengthUnits);
  require_range("height", area.height, kSmallest, kLargest, kLengthUnits);
  require_range("x_centre", area.x_centre, -kLargest, kLargest, kLengthUnits);
  require_range("y_centre", area.y_centre, -kLargest, kLargest, kLengthUnits);
  const auto most = static_cast<double>(kMostScanPixels);
  require_range("columns", static_cast<double>(area.columns), 2.0, most, kPlainNumber);
  require_range("rows", static_cast<double>(area.rows), 1.0, most, kPlainNumber);
}

}  // namespace afm::physics
