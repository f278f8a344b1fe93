// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"
#include "curves/contact_options.h"
#include "imaging/scan_surface.h"
#include "physics/imaging/scan_settings.h"
#include "physics/imaging/tip_shape.h"

namespace afm::instrument {

// Faults that occur on purpose; zero: none.
struct Faults {
  double force_noise_n = 0;       // rms of the white noise in each point of a curve
  double detector_range_n = 0;    // largest magnitude of a force that a curve can show; zero: unlimited
  double blunting_force_n = 0;    // push beyond which the tip wears; zero: never
  double blunting_m_per_n = 1.0;  // growth of the tip radius per newton beyond it, once per curve or line
  double false_engagement = 0;    // probability that an approach stops above the sample
  double tip_change = 0;          // probability that the tip grows or loses a second apex before a line
  double second_apex_m = 20e-9;   // distance of the second apex, along +x
};

// Everything that a client sets, in SI. The contact's numbers are those of the material unless they are given.
struct InstrumentSettings {
  curves::ContactOptions contact;
  physics::TipShape tip;  // kind and half angle of the tip, whose radius is the contact's
  physics::ScanSettings scan;
  bool flat = false;    // true: a level sample in place of the drawn one
  double size_m = 0;    // width of an image; zero: width of the sample
  double height_m = 0;  // height of an image; zero: square pixels
  double turn_rad = 0;  // rotation of the image about its middle, counterclockwise
  std::size_t pixels = 64;
  std::size_t lines = 0;            // number of lines; zero: equal to `pixels`
  bool upwards = false;             // true: the slow scan begins at the bottom
  bool taps = false;                // true: images in tapping mode
  double amplitude_setpoint = 0.8;  // amplitude that the feedback keeps, as a fraction of the free amplitude
  double free_amplitude_m = 20e-9;  // free amplitude, zero-to-peak
  double drive_hz = 0;              // drive frequency; zero: the resonance
  double viscosity_pa_s = 0;        // viscosity of the contact
  Faults faults;

  std::size_t lines_or_pixels() const { return lines > 0 ? lines : pixels; }
};

// Widest image of a client: 1024 lines are answered within seconds.
inline constexpr std::size_t kMostInstrumentPixels = 1024;

// Contact as of curves::contact_setup(). The lever may have a resonance and a quality factor that a static law does not
// use: its spectrum and its swing do.
core::Result<curves::ContactSetup> contact_of(const curves::ContactOptions& options);

// Settings as {"material": "mica", "line_rate_hz": 2.0, ...}: every key that change() accepts, and its value now. A
// number of the contact that is not given is the material's, or null if the material has none.
nlohmann::ordered_json settings_json(const InstrumentSettings& settings, const curves::ContactSetup& setup);

// Sets the values of an object; null for a number of the contact: that of the material. WrongUsage, naming the
// key, its range and unit, for an unknown key and for any other value, without a change.
core::Result<void> change(const nlohmann::ordered_json& values, InstrumentSettings& settings);

// Keys and texts that a microscope writes into its image files: what its operator chose, without faults and the
// numbers of the contact.
std::vector<std::pair<std::string, std::string>> image_metadata(const InstrumentSettings& settings);

}  // namespace afm::instrument
