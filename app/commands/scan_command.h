// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "app/options/contact_options.h"
#include "core/result.h"
#include "exhibit/scan/scan_surface.h"
#include "physics/imaging/scan_settings.h"
#include "physics/imaging/tip_shape.h"

namespace afm::app {

// Options of `touchafm scan`; empty text and zero: not given.
struct ScanOptions {
  curves::ContactOptions contact;
  exhibit::OwnSample sample;
  physics::Length size;  // zero: the size of the drawn sample
  std::size_t pixels = 256;
  physics::Length x_centre, y_centre;
  physics::SlowDirection direction = physics::SlowDirection::Down;
  physics::Feedback feedback = physics::Feedback::On;
  std::vector<std::pair<const physics::ScanField*, double>> settings;  // explicitly given settings, in SI
  physics::TipShape tip;  // without radius and second apex, which come from contact and settings
  std::uint32_t seed = 1;
  bool show_truth = false;
  bool json = false;
  std::string channel;  // empty: all channels, or the height in a .gsf
  std::string out;
  std::string picture;
};

// Scans, then writes. Each file is written completely or not at all.
core::Result<void> write_scan_command(const ScanOptions& options);

// Adds all options but those of the output; returns --tip. `options` must outlive the parsing of `command`.
Option add_scan_options(OptionList& command, ScanOptions& options, const CommandContext& context);

// What follows from the others once all are parsed.
void complete(ScanOptions& options, bool tip_is_given);

// An image, the surface that the apex would trace without any artefact, on its grid, both as .gwy; and in JSON the
// settings, the seed and the lines with each artefact.
struct TrueScan {
  std::string image, true_image, truth;
};
core::Result<TrueScan> scan_with_truth(const ScanOptions& options);

}  // namespace afm::app
