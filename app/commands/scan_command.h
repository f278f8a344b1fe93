// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/options/contact_options.h"
#include "core/result.h"
#include "imaging/scan_run.h"

namespace afm::app {

// Options of `touchafm scan`; empty text: not given.
struct ScanOptions : imaging::ScanRequest {
  bool json = false;
  std::string channel;  // name of one channel; empty: all of them, or the height in a .gsf
  std::string out;
  std::string picture;
};

// Scans, then writes. Each file is written completely or not at all.
core::Result<void> write_scan_command(const ScanOptions& options);

// Adds all options but those of the output; returns --tip. `options` must outlive the parsing of `command`.
Option add_scan_options(OptionList& command, ScanOptions& options, const CommandContext& context);

// An image, the surface that the apex would trace without any artefact on the same grid, both as .gwy; and as JSON the
// settings, the seed and the lines with each artefact.
struct TrueScan {
  std::string image, true_image, truth;
};
core::Result<TrueScan> scan_with_truth(const ScanOptions& options);

}  // namespace afm::app
