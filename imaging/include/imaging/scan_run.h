// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <numbers>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "core/enumerators.h"
#include "core/result.h"
#include "curves/contact_options.h"
#include "curves/quantity_domain.h"
#include "curves/tapping/driven_setup.h"
#include "imaging/scan_surface.h"
#include "physics/imaging/scan_artefact.h"
#include "physics/imaging/scan_image.h"
#include "physics/imaging/scan_settings.h"
#include "physics/imaging/tip_shape.h"

namespace afm::imaging {

// An image as a user asks for it: the options of `touchafm scan`. Empty text and zero: not given.
struct ScanRequest {
  curves::ContactOptions contact;
  OwnSample sample;
  physics::Length size;  // width of the area; zero: the width of the drawn sample
  std::size_t pixels = 256;
  physics::Length x_centre, y_centre;
  physics::SlowDirection direction = physics::SlowDirection::Down;
  physics::Feedback feedback = physics::Feedback::On;
  std::vector<std::pair<const physics::ScanField*, double>> settings;  // settings given explicitly, in SI
  curves::TappingChoice tapping;                                       // tapping; the mode is contact or tapping
  std::string amplitude_setpoint;  // setpoint of tapping mode as typed: fraction of the free amplitude, or a length
  physics::TipShape tip;           // shape without radius and second apex, which come from contact and settings
  std::uint32_t seed = 1;
  bool show_truth = false;
};

struct DirectionName {
  const char* name;
  physics::SlowDirection direction;
};
inline constexpr std::array kDirections{DirectionName{"down", physics::SlowDirection::Down},
                                        DirectionName{"up", physics::SlowDirection::Up}};
static_assert(core::has_row_for_each(kDirections, &DirectionName::direction));

// Legal values of a request: number of pixels, sizes, places, half angles.
inline constexpr std::size_t kFewestPixels = 2;
inline constexpr curves::QuantityRange<double> kScanSizesM{1e-10, 1e-4}, kScanPlacesM{-1e-4, 1e-4},
    kTipAnglesRad{std::numbers::pi / 180.0, std::numbers::pi * 0.45};

// Fills in what follows from the rest: a user's image is traced unless a tip is given, with mica's contact.
void complete(ScanRequest& request, bool tip_is_given);

// WrongUsage for a request without a material, and for a setting without effect in its mode.
core::Result<void> check(const ScanRequest& request);

// An image, its settings, and the lines with each detected artefact.
struct Scan {
  physics::ScanImage image;
  physics::ScanSettings settings;
  std::map<physics::ScanArtefact, std::size_t> lines_with;
  std::optional<physics::TappingDetector> tapping;  // detector of tapping mode; empty: contact mode
  double time_s = 0;
  physics::Scanner::Surface surface{};  // surface that the apex would trace without any artefact
};

// Takes the image; of many lines it logs the progress. After a request to stop, the lines so far. Fails as check(),
// curves::contact_setup() and scan_surface(), and with WrongUsage for an unphysical request. Any thread; allocates.
core::Result<Scan> take_scan(const ScanRequest& request, const std::stop_token& stop = {});

// Settings and figures of every channel in SI, as `touchafm scan --json` prints them.
nlohmann::json scan_json(const Scan& scan);

// The surface without artefacts on the image's grid, at time zero, because drift is an artefact.
physics::ScanImage true_image_of(const Scan& scan);

// Keeps one channel. WrongUsage, with all names, if there is none of that name.
core::Result<void> keep_channel(const std::string& name, physics::ScanImage& image);

}  // namespace afm::imaging
