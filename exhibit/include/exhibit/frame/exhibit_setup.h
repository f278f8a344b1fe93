// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "exhibit/frame/wall_pictures.h"
#include "exhibit/scenery/wall_scene.h"
#include "exhibit/words/phrases.h"
#include "physics/imaging/levelling.h"
#include "render/renderer.h"
#include "scene/display/wall.h"
#include "scene/samples/material_library.h"

namespace afm::exhibit {

// Number of samples for which the shelf has room.
inline constexpr std::size_t kMostMaterials = 9;

// Languages of the assets, such as guidance/en.toml.
struct LanguageRow {
  std::string_view word;
  std::string_view name;  // English name
};
inline constexpr std::array kLanguages{LanguageRow{"en", "English"}, LanguageRow{"de", "German"}};

// Language of the first set one of the values of LC_ALL, LC_MESSAGES and LANG: "de" for "de_AT.UTF-8"; "en" if the
// assets lack it.
std::string language_of_locale(std::span<const std::string> values);

// Largest enlargement for which panels have room.
inline constexpr double kLargestText = 1.5;

// Files and options that determine the exhibit.
struct ExhibitFiles {
  std::string assets_dir;
  std::string wall;                // empty: the paper's wall from the assets
  std::optional<double> aspect{};  // width to height of the picture, to which the paper's wall is fitted
  double text_size = 1.0;          // enlargement of panels that have room, 1 to kLargestText
  std::string language = "en";     // a row of kLanguages
  std::string guidance;            // user's phrase file with replacements; empty: none
  std::string materials;           // user's file; empty: none
  std::string probe;               // user's glTF model in place of the assets'; empty: none
  std::string sample;              // the same for all materials, or an instrument's image
  std::string sample_channel;      // channel of that image; empty: its height
  physics::Levelling sample_levelling = physics::Levelling::Plane;
  std::vector<std::string> shown;           // names; empty: all of the user's file, or the paper's three
  std::vector<scene::MaterialEntry> added;  // shown after the others
};

// English, and the language of the wall: its phrase file with the user's replacements.
struct LoadedPhrases {
  Phrases english, wall;
};
core::Result<LoadedPhrases> load_phrases(const ExhibitFiles& files);

// Everything that is loaded before the exhibit starts.
struct Stage {
  scene::MaterialLibrary materials;
  scene::Wall wall;
  scene::Screen screen;  // screen with the scene: StagePlace::main
  std::array<scene::EyeView, 2> eyes;
  WallScene wall_scene;
  Phrases english;  // language of the log, for staff and bug reports

  const Phrases& phrases() const { return wall_scene.phrases(); }

  // Titles of the materials in the language of the wall.
  std::vector<std::string> titles() const;

  // Pixels are square: the height follows from the wall's proportions.
  render::RendererOptions renderer_options(std::uint32_t eye_width) const;

  // Size of the largest eye images with the wall's proportions whose picture fits into a window.
  glm::uvec2 eye_size_within(scene::StereoMode mode, glm::uvec2 window_px) const;
};

core::Result<Stage> load_exhibit(const ExhibitFiles& files);

// Returns whether the name is that of a glTF file: .glb or .gltf.
bool is_model_file(const std::string& name);

}  // namespace afm::exhibit
