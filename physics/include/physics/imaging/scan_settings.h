// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "physics/quantity_text.h"
#include "physics/units.h"

namespace afm::physics {

enum class Feedback { On, Off };

// Direction of a frame along the slow axis: Down begins at the top row, Up at the bottom one.
enum class SlowDirection { Down, Up };

// The area of one frame, in the sample's frame at time zero. The fast axis is x.
struct ScanArea {
  Length width{500e-9};
  Length height{500e-9};
  Length x_centre;
  Length y_centre;
  std::size_t columns = 256;  // number of columns, 2 to kMostScanPixels
  std::size_t rows = 256;     // number of rows, 1 to kMostScanPixels
};

inline constexpr std::size_t kMostScanPixels = 4096;

// Settings that may change during a scan: the microscope in static contact mode. The tip's shape and radius are not
// included; they determine the surface traced by the apex (physics/imaging/morphology.h).
struct ScanSettings {
  Frequency line_rate{2.0};          // lines a second, each there and back: tip speed 2 * width * line_rate
  Force setpoint{0.5e-9};            // lever force; negative: only adhesion holds the tip
  Frequency integral_gain{1000.0};   // gain of the integrator; on a rigid contact 1/tau of the closed loop
  double proportional_gain = 0.0;    // gain of the velocity form, per tick: below one
  Frequency loop_rate{100e3};        // lower limit of the controller's tick rate
  Time detector_delay;               // delay until the controller sees a deflection; rounded to ticks
  Frequency z_resonance{5e3};        // resonance of the z scanner; zero: it follows its command at once
  double z_quality_factor = 10.0;    // quality factor of that resonance
  Length z_range{10e-6};             // range of the z scanner, half above and half below z = 0
  Stiffness spring_constant{0.1};    // lever stiffness
  Force adhesion{0.5e-9};            // magnitude of the pull at which the tip leaves the surface
  Length snap_in;                    // gap at which a free tip touches again
  double friction = 0.3;             // coefficient mu of the lateral friction
  Length noise;                      // rms of the detected deflection within kNoiseBandwidth; white
  Velocity drift_x;                  // drift of the sample against the scanner
  Velocity drift_y;                  // drift of the sample against the scanner; positive: upwards, towards row 0
  Length second_apex_distance;       // distance of the second apex along +x; zero: there is none
  Length second_apex_height;         // height of the second apex's end above the first apex
  Feedback feedback = Feedback::On;  // off: the z scanner stays where it is
};

// The bandwidth in which `noise` is given; its one-sided power density is noise^2/kNoiseBandwidth.
inline constexpr Frequency kNoiseBandwidth{1e3};

// The rms that the detector's noise has in the height, on a rigid contact: sqrt(S/(4 tau)), S its power density.
Length noise_of_height(const ScanSettings& settings) noexcept;

// Description of one member of ScanSettings for options, files, panels and checks.
struct ScanField {
  std::string_view name;                        // name of the member; messages print it with spaces for underscores
  std::string_view option;                      // option of the command line, without its dashes
  std::string_view json_key;                    // key of its SI value
  std::string_view help;                        // description for help texts
  double smallest;                              // smallest legal value, SI
  double largest;                               // largest legal value, SI
  const Units* units;                           // units of the value; kPlainNumber if it has none
  double (*get)(const ScanSettings& settings);  // getter of the SI value
  void (*set)(ScanSettings& settings, double si);

  std::string text(double si) const { return format_si(si, units->units); }  // value as text: "500 pN", "0.3"
};

inline constexpr std::size_t kScanFieldCount = 18;

// Rows in the order of the members, without Feedback, which is not a number.
extern const std::array<ScanField, kScanFieldCount> kScanFields;

// Throw UnphysicalValue unless every number is within its range.
void validate(const ScanSettings& settings);
void validate(const ScanArea& area);

}  // namespace afm::physics
