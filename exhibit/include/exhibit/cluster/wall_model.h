// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "curves/tapping/tapped_hand.h"
#include "exhibit/frame/exhibit_files.h"
#include "exhibit/frame/wall_pictures.h"
#include "physics/friction/friction.h"
#include "render/renderer.h"

namespace afm::exhibit {

// All inputs that a node needs before the first frame. The files are included as texts, so the node need not have them.
struct WallModel {
  std::uint64_t build = 0;                    // digest of the program; another build may produce other frames
  std::uint64_t scene = 0;                    // digest of the scene; it differs for other models
  std::string wall;                           // text of the wall file
  std::string guidance;                       // text of the user's phrase file; empty: none
  std::string materials;                      // text of the user's material file; empty: none
  std::map<std::string, std::string> meshes;  // texts of the outputs' meshes by name, relative to the wall file
  ExhibitFiles files;                         // all other files; without these three texts and the assets
  physics::FrictionLaw friction = physics::FrictionLaw::None;
  curves::TappedHand tapping;
  PictureOptions picture;  // mode and order of the eyes
  render::PanelContrast contrast = render::PanelContrast::Normal;
};

std::vector<std::byte> document_of(const WallModel& model);

// BadInputFile if the document is malformed or has an invalid value.
core::Result<WallModel> read_wall_model(std::span<const std::byte> document);

// Returns whether a file of this name is in the same folder as another file, or below: no other place may be written.
bool lies_beside(const std::string& name);

// Writes the texts into `folder` and returns the wall's files. A user's models keep their names on the master.
core::Result<ExhibitFiles> unpack(const WallModel& model, const std::string& assets_dir, const std::string& folder);

// Digest of a program's executable file.
core::Result<std::uint64_t> build_digest(const std::string& program);

}  // namespace afm::exhibit
