// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "exhibit/frame/exhibit_files.h"
#include "exhibit/scenery/wall_scene.h"
#include "exhibit/words/phrases.h"
#include "scene/display/wall.h"
#include "scene/samples/material_library.h"

namespace afm::curves {
struct SampleModel;
struct TappedHand;
}  // namespace afm::curves

namespace afm::physics {
enum class FrictionLaw : std::uint32_t;
}

namespace afm::render {
struct RendererOptions;
}

namespace afm::scene {
struct ParticleSet;
}

namespace afm::exhibit {

// English phrases, and those of the wall's language: its phrase file with the user's replacements.
struct LoadedPhrases {
  Phrases english, wall;
};
core::Result<LoadedPhrases> load_phrases(const ExhibitFiles& files);

// Data loaded before the exhibit starts.
struct Stage {
  scene::MaterialLibrary materials;
  scene::Wall wall;
  scene::Screen screen;  // screen with the scene: StagePlace::main
  std::array<scene::EyeView, 2> eyes;
  WallScene wall_scene;
  Phrases english;                                      // phrases of the log, for staff and bug reports
  std::shared_ptr<const scene::ParticleSet> particles;  // particles on the wall; null: none
  std::shared_ptr<const curves::SampleModel>
      pixel;  // first pixel of the force map, whose material has the map's name; null: none

  const Phrases& phrases() const { return wall_scene.phrases(); }

  // Titles of the materials in the language of the wall.
  std::vector<std::string> titles() const;

  // Curves of measured materials, for SharedModel.
  std::span<const scene::SharedMeasuredCurve> recorded_curves() const;

  // Pixels are square: the height follows from the wall's proportions.
  render::RendererOptions renderer_options(std::uint32_t eye_width) const;

  // Size of the largest eye images with the wall's proportions whose picture fits into a window.
  glm::uvec2 eye_size_within(scene::StereoMode mode, glm::uvec2 window_px) const;
};

// Reads a whole force map: a large one takes minutes, with progress in the log; Failed if interrupted.
core::Result<Stage> load_exhibit(const ExhibitFiles& files);

// Samples of the stage for the servo, with the surfaces that the stage draws; in tapping mode under the
// lever of `tapping` and without friction.
core::Result<std::vector<curves::SampleModel>> felt_samples(const Stage& stage, physics::FrictionLaw friction,
                                                            const curves::TappedHand* tapping = nullptr);

// Returns whether the name is that of a glTF file: .glb or .gltf.
bool is_model_file(const std::string& name);

}  // namespace afm::exhibit
