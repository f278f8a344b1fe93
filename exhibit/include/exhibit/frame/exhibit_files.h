// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "physics/imaging/levelling.h"
#include "scene/samples/material_library.h"

namespace afm::exhibit {

// The capacity of the shelf in front of the wall.
inline constexpr std::size_t kMostMaterials = 9;

// The languages of the assets: guidance/en.toml and on.
struct LanguageRow {
  std::string_view word;
  std::string_view name;  // in English
};
inline constexpr std::array kLanguages{LanguageRow{"en", "English"}, LanguageRow{"de", "German"}};

// The first of these values of LC_ALL, LC_MESSAGES and LANG that is set decides: "de" for "de_AT.UTF-8"; "en" for a
// language that the assets lack.
std::string language_of_locale(std::span<const std::string> values);

// Beyond it panels have no room for their words.
inline constexpr double kLargestText = 1.5;

// The files that a picture of the wall is made of.
struct ExhibitFiles {
  std::string assets_dir;
  std::string wall;                // empty: the paper's wall in the assets
  std::optional<double> aspect{};  // width to height of the picture, which the paper's wall takes on
  double text_size = 1.0;          // 1 to kLargestText: how much larger panels are drawn, where they have the room
  std::string language = "en";     // a row of kLanguages
  std::string guidance;            // a phrase file of the user's own on top of it; empty: none
  std::string materials;           // a file of the user's own; empty: none
  std::string probe;               // a glTF model of the user's own instead of the assets'; empty: none
  std::string sample;              // the same, of all materials; or an image that an instrument measured
  std::string sample_channel;      // of the image; empty: its height
  physics::Levelling sample_levelling = physics::Levelling::Plane;
  std::vector<std::string> shown;           // names; empty: those of the user's file, or the paper's three
  std::vector<scene::MaterialEntry> added;  // shown behind those
};

}  // namespace afm::exhibit
