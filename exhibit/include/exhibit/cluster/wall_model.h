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
#include "exhibit/frame/exhibit_setup.h"
#include "physics/friction/friction.h"
#include "render/renderer.h"

namespace afm::exhibit {

// All that a node needs before the first frame; the files are texts, which it does not need to have.
struct WallModel {
  std::uint64_t build = 0;                    // digest of the program: another one may build other frames
  std::uint64_t scene = 0;                    // digest of the scene: a node that has other models shows another one
  std::string wall;                           // text of the wall file
  std::string guidance;                       // likewise; empty: none
  std::string materials;                      // likewise
  std::map<std::string, std::string> meshes;  // of the outputs: text by name, beside the wall file or below
  ExhibitFiles files;                         // without those three, and without the assets
  physics::FrictionLaw friction = physics::FrictionLaw::None;
  PictureOptions picture;  // mode and order of the eyes
  render::PanelContrast contrast = render::PanelContrast::Normal;
};

std::vector<std::byte> document_of(const WallModel& model);

// BadInputFile: the document is none, or holds something that is not valid.
core::Result<WallModel> read_wall_model(std::span<const std::byte> document);

// Whether a file of this name lies beside another one, or in a folder below: no other place is written to.
bool lies_beside(const std::string& name);

// Writes the texts into `folder` and gives the files of the wall; those of the user's own models are named as on the
// master.
core::Result<ExhibitFiles> unpack(const WallModel& model, const std::string& assets_dir, const std::string& folder);

// The digest of a program's file.
core::Result<std::uint64_t> build_digest(const std::string& program);

}  // namespace afm::exhibit
