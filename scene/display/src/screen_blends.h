// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scene/display/wall.h"

namespace afm::scene {

// A key of a wall file that cannot be so.
struct BlendFault {
  enum class Table { Screen, Output } table;
  std::size_t index;  // of the table
  std::string key;
  std::string what;
};

// Widths of ramps that a person gives, by ScreenEdge.
using EdgeWidths = std::array<std::optional<double>, kScreenEdgeNames.size()>;

// Finds the screens that overlap, and sets Screen::blend: ramps across the whole overlap, or of a given width in its
// middle. What overlaps by less than kLeastOverlapM, or lies within another screen, is not blended.
inline constexpr double kLeastOverlapM = 0.010;
std::optional<BlendFault> blend_screens(std::vector<Screen>& screens, const std::vector<EdgeWidths>& widths_m);

// What is known of an output's projector.
struct ProjectorLight {
  std::optional<double> gamma, black;
};

// Sets Output::blend where screens overlap; one entry of `lights` an output.
std::optional<BlendFault> blend_outputs(Wall& wall, const std::vector<ProjectorLight>& lights);

}  // namespace afm::scene
