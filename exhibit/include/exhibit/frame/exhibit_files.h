// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "physics/imaging/levelling.h"
#include "scene/samples/material_library.h"

namespace afm::curves {
struct MapReading;
}

namespace afm::scene {
enum class MapVibration : std::uint32_t;
struct ParticleSet;
}  // namespace afm::scene

namespace afm::exhibit {

// Number of samples that fit on the shelf.
inline constexpr std::size_t kMostMaterials = 9;

// Languages of the assets, such as guidance/en.toml.
struct LanguageRow {
  std::string_view word;
  std::string_view name;  // English name
};
inline constexpr std::array kLanguages{LanguageRow{"en", "English"}, LanguageRow{"de", "German"}};

// Language of the first value that is set, of LC_ALL, LC_MESSAGES and LANG: "de" for "de_AT.UTF-8"; "en" if the assets
// lack it.
std::string language_of_locale(std::span<const std::string> values);

// Largest enlargement of text for which panels have room.
inline constexpr double kLargestText = 1.5;

// Files and options that determine the exhibit.
struct ExhibitFiles {
  std::string assets_dir;
  std::string wall;                // wall file; empty: the paper's wall from the assets
  std::optional<double> aspect{};  // width to height of the picture; the paper's wall is fitted to it
  double text_size = 1.0;          // enlargement of text in panels that have room, 1 to kLargestText
  std::string language = "en";     // word of a row of kLanguages
  std::string guidance;            // user's phrase file with replacements; empty: none
  std::string materials;           // user's material file; empty: none
  std::string probe;               // user's glTF model in place of the assets'; empty: none
  std::string sample;              // user's model for all materials, or an instrument's image
  std::string sample_channel;      // channel of that image; empty: its height
  physics::Levelling sample_levelling = physics::Levelling::Plane;
  std::string particles;  // set of assets/particles, or a user's file; level sample; empty: none
  std::shared_ptr<const scene::ParticleSet> recorded_particles;  // recorded particles in their place; null: none
  std::string force_map;                                         // file of a force map, one more sample; empty: none
  // shared, so that this header need not know its type; null: the file's calibration, without a fit
  std::shared_ptr<const curves::MapReading> map_reading;
  std::optional<std::array<std::size_t, 2>>
      pixel;                                // column and row of the pixel felt first (curves::MapPlace); empty: middle
  bool whole_map = false;                   // true: whole fitted map felt instead of one pixel
  bool viscous_map = false;                 // true: whole map with damping of the hand
  scene::MapVibration map_vibration{};      // quantity felt as a vibration
  std::optional<double> equal_force_n{};    // force of the surface shown first over the map; empty: none
  std::vector<std::string> shown;           // names of materials; empty: all in the user's file, or the paper's three
  std::vector<scene::MaterialEntry> added;  // materials shown after the others
};

}  // namespace afm::exhibit
