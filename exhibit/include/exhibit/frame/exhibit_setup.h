// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "exhibit/frame/exhibit_files.h"
#include "exhibit/frame/wall_pictures.h"
#include "exhibit/scenery/wall_scene.h"
#include "exhibit/words/phrases.h"
#include "render/renderer.h"
#include "scene/display/wall.h"
#include "scene/samples/material_library.h"

namespace afm::exhibit {

// English, and the language of the wall: the file of that language with the user's own file on top.
struct LoadedPhrases {
  Phrases english, wall;
};
core::Result<LoadedPhrases> load_phrases(const ExhibitFiles& files);

// All that is loaded before anything moves.
struct Stage {
  scene::MaterialLibrary materials;
  scene::Wall wall;
  scene::Screen screen;  // of the scene: StagePlace::main
  std::array<scene::EyeView, 2> eyes;
  WallScene wall_scene;
  Phrases english;  // for the log, which staff and bug reports share

  const Phrases& phrases() const { return wall_scene.phrases(); }

  // Of the materials, in the language of the wall.
  std::vector<std::string> titles() const;

  // Square pixels: the height follows the wall's proportions.
  render::RendererOptions renderer_options(std::uint32_t eye_width) const;

  // The largest eye images, at the wall's proportions, whose picture fits into a window.
  glm::uvec2 eye_size_within(scene::StereoMode mode, glm::uvec2 window_px) const;
};

core::Result<Stage> load_exhibit(const ExhibitFiles& files);

// True for the name of a glTF file: .glb or .gltf.
bool is_model_file(const std::string& name);

}  // namespace afm::exhibit
