// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "input/dtrack_source.h"
#include "input/hid_mapping.h"

namespace afm::input {

// Contents of a wand file (TOML): position of the hand, tracker, mapping of an HID device.
struct WandFile {
  std::optional<glm::dvec3> hand_m;  // position of the hand in the room frame, for a wand without position tracking
  std::optional<DtrackSettings> dtrack;
  std::optional<std::uint32_t> head_body;  // number of the head's body in the tracker
  std::optional<HidMapping> device;
};

// Reads and checks a wand file. The error names file, line and key.
core::Result<WandFile> load_wand_file(const std::string& path);

// Mappings from all *.toml files in a folder, in the order of their names.
core::Result<std::vector<HidMapping>> load_mappings(const std::string& folder);

}  // namespace afm::input
