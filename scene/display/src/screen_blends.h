// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scene/display/wall.h"

namespace afm::scene {

// Key of a wall file with an impossible value.
struct BlendFault {
  enum class Table { Screen, Output } table;
  std::size_t index;  // index of the table in the file
  std::string key;
  std::string what;
};

// Ramp widths given in the file, indexed by ScreenEdge.
using EdgeWidths = std::array<std::optional<double>, kScreenEdgeNames.size()>;

// Finds overlapping screens, and sets Screen::blend: ramps across the whole overlap, or of a given width in its middle.
// Overlaps below kLeastOverlapM, and screens inside another screen, are not blended.
inline constexpr double kLeastOverlapM = 0.010;
std::optional<BlendFault> blend_screens(std::vector<Screen>& screens, const std::vector<EdgeWidths>& widths_m);

// Light of an output's projector, as far as known.
struct ProjectorLight {
  std::optional<double> gamma, black;
};

// Sets Output::blend where screens overlap; `lights` has one entry per output.
std::optional<BlendFault> blend_outputs(Wall& wall, const std::vector<ProjectorLight>& lights);

}  // namespace afm::scene
