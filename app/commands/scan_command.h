// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "app/options/contact_options.h"
#include "core/result.h"
#include "physics/imaging/scan_settings.h"
#include "physics/imaging/tip_shape.h"

namespace afm::app {

// Options of `touchafm scan`; empty text and zero: not given.
struct ScanOptions {
  ContactOptions contact;
  physics::Length size;  // zero: of the drawn sample
  std::size_t pixels = 256;
  physics::Length x_centre, y_centre;
  physics::SlowDirection direction = physics::SlowDirection::Down;
  physics::Feedback feedback = physics::Feedback::On;
  std::vector<std::pair<const physics::ScanField*, double>> settings;  // given ones, in SI
  physics::TipShape tip;  // its radius is that of the contact, its second apex that of the settings
  std::uint32_t seed = 1;
  bool show_truth = false;
  bool json = false;
  std::string channel;  // empty: all of them, in a .gsf the height
  std::string out;
  std::string picture;
};

// Scans, then writes. Each file is whole or absent.
core::Result<void> write_scan_command(const ScanOptions& options);

}  // namespace afm::app
